#include "fold_picture.h"

#include <algorithm>

#include "curve.h"

namespace physics {
namespace {

// Sizes in the picture, in its units.
constexpr double kViewWidth = 300, kViewHeight = 300, kScale = 44, kHead = 30, kChartHeight = 150, kMargin = 50;
const char* const kBlue = "#1f5fa8";
const char* const kRed = "#c0392b";

// A point of space in a view: from the side, seen a little from above.
std::string place(std::size_t view, const Vector3& at) {
  const double deep = at.y() - 2;
  const double x = kViewWidth * (static_cast<double>(view) + 0.5) + kScale * (at.x() - 4 + 0.35 * deep);
  return std::to_string(x) + "," + std::to_string(kHead + kViewHeight - 15 - kScale * (at.z() + 0.2 * deep));
}

void draw_view(std::size_t number, const FoldView& view, bool flat, std::ostream& out) {
  // The roof from back to front: its far end, the slopes, its near end.
  const Vector3 back(0, flat ? 0 : 1, 0), front = -back;
  const Positions end = roof();
  const auto draw_wall = [&](const Positions& corners, const char* colour) {
    out << "<polygon stroke=\"#8a8073\" fill=\"" << colour << "\" points=\"";
    for (const Vector3& corner : corners) {
      out << place(number, corner) << ' ';
    }
    out << "\"/>\n";
  };
  for (std::size_t k = 0; k + 1 < end.size(); ++k) {
    draw_wall({end[k] + back, end[k + 1] + back, end[k + 1] + front, end[k] + front}, "#efeae2");
  }
  draw_wall({end[0] + front, end[1] + front, end[2] + front, end[3] + front, end[4] + front}, "#e3ddd3");
  out << "<path stroke=\"" << kBlue << "\" fill=\"none\" d=\"";
  for (std::size_t k = 0; k < view.edges.size(); k += 2) {
    out << 'M' << place(number, view.position[view.edges[k]]) << 'L' << place(number, view.position[view.edges[k + 1]]);
  }
  out << "\"/>\n<path stroke=\"" << kRed << "\" stroke-width=\"6\" stroke-linecap=\"round\" d=\"";
  for (std::size_t i = 0; i < view.inserted.size(); ++i) {
    out << (view.inserted[i] ? "M" + place(number, view.position[i]) + "h0" : std::string());
  }
  out << "\"/>\n<text text-anchor=\"middle\" y=\"20\" x=\"" << kViewWidth * (static_cast<double>(number) + 0.5) << "\">"
      << view.title << "</text>\n";
}

// A value of each step, as a line from 0 (below) to `most` (above).
void draw_line(const std::vector<FoldStep>& steps, double width, double most, double (*value)(const FoldStep&),
               const char* colour, std::ostream& out) {
  out << "<polyline fill=\"none\" stroke=\"" << colour << "\" points=\"";
  for (std::size_t k = 0; k < steps.size(); ++k) {
    out << kMargin + width * static_cast<double>(k) / static_cast<double>(steps.size()) << ','
        << kHead + kViewHeight + 40 + kChartHeight * (1 - value(steps[k]) / most) << ' ';
  }
  out << "\"/>\n";
}

void draw_chart(const std::vector<FoldStep>& steps, const FoldOptions& options, double width, std::ostream& out) {
  const double top = kHead + kViewHeight + 40, bottom = top + kChartHeight;
  double most_vertices = 1, most_pull = 1e-3;
  for (const FoldStep& step : steps) {
    most_vertices = std::max(most_vertices, static_cast<double>(step.vertices));
    most_pull = std::max(most_pull, step.largest_pull);
  }
  const int ends[] = {0, options.press, options.press + options.lift, options.press + options.lift + options.rest};
  const char* const names[] = {"pressed on the ridge", "lifted", "left alone"};
  for (int phase = 0; phase < 3; ++phase) {
    const double left = kMargin + width * ends[phase] / ends[3], right = kMargin + width * ends[phase + 1] / ends[3];
    out << "<rect fill=\"" << (phase == 1 ? "#eceff4" : "#f7f8fa") << "\" x=\"" << left << "\" y=\"" << top
        << "\" width=\"" << right - left << "\" height=\"" << kChartHeight << "\"/>\n<text text-anchor=\"middle\" x=\""
        << (left + right) / 2 << "\" y=\"" << bottom + 18 << "\">" << names[phase] << "</text>\n";
  }
  const double limit = bottom - kChartHeight * options.negligible / most_pull;
  out << "<path stroke=\"" << kBlue << "\" stroke-dasharray=\"4 4\" d=\"M" << kMargin << ' ' << limit << 'h' << width
      << "\"/>\n";
  draw_line(
      steps, width, most_pull, [](const FoldStep& step) { return step.largest_pull; }, kBlue, out);
  draw_line(
      steps, width, most_vertices, [](const FoldStep& step) { return static_cast<double>(step.vertices); }, kRed, out);
  out << "<text fill=\"" << kRed << "\" x=\"" << kMargin + 8 << "\" y=\"" << top - 6 << "\">vertices, up to "
      << most_vertices << "</text>\n<text fill=\"" << kBlue << "\" x=\"" << kMargin + 190 << "\" y=\"" << top - 6
      << "\">largest pull, up to " << in_words(most_pull) << " radii; dashed: negligible below "
      << in_words(options.negligible) << "</text>\n";
}

}  // namespace

FoldView view_of(Fold& fold, const std::string& title) {
  FoldView view{title, fold.in_space(), fold.edges(), {}};
  for (std::size_t i = 0; i < view.position.size(); ++i) {
    view.inserted.push_back(fold.body().was_inserted(i) ? 1 : 0);
  }
  return view;
}

void draw_fold(const std::vector<FoldView>& views, const std::vector<FoldStep>& steps, const FoldOptions& options,
               std::ostream& out) {
  const double width = kViewWidth * static_cast<double>(views.size());
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' '
      << kHead + kViewHeight + kChartHeight + 70 << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  for (std::size_t number = 0; number < views.size(); ++number) {
    draw_view(number, views[number], options.body == FoldBody::kPlane, out);
  }
  draw_chart(steps, options, width - 2 * kMargin, out);
  out << "</svg>\n";
}

}  // namespace physics
