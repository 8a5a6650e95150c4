#include "picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "svg.h"

namespace knot {
namespace {

constexpr double kScale = 34, kWide = 20, kHigh = 7.6;  // of one panel, in units of the scene

void line(const svg_view& view, const Point& a, const Point& b, const char* style) {
  const double ends[4] = {a[0], a[1], b[0], b[1]};
  svg_line(&view, ends, 2, style);
}

/// Part of a segment round a place on it, so long on either side.
void part(const svg_view& view, const Point& a, const Point& b, double share, double half, const char* style) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], around = half / std::hypot(dx, dy);
  const double from = std::max(0.0, share - around), to = std::min(1.0, share + around);
  line(view, {a[0] + from * dx, a[1] + from * dy, 0}, {a[0] + to * dx, a[1] + to * dy, 0}, style);
}

/// What lies above leaves a gap beside it in what lies below.
void draw_crossings(const svg_view& view, const std::vector<Point>& at) {
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    for (std::size_t j = i + 2; j + 1 < at.size(); ++j) {
      const Point &a = at[i], &b = at[i + 1], &c = at[j], &d = at[j + 1];
      const double ux = b[0] - a[0], uy = b[1] - a[1], vx = d[0] - c[0], vy = d[1] - c[1], area = ux * vy - uy * vx;
      const double s = ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / area;
      const double t = ((c[0] - a[0]) * uy - (c[1] - a[1]) * ux) / area;
      if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) continue;
      const bool first = a[2] + s * (b[2] - a[2]) > c[2] + t * (d[2] - c[2]);
      const Point &from = first ? a : c, &to = first ? b : d;
      part(view, from, to, first ? s : t, 0.13,
           "stroke=\"#fff\" stroke-width=\"9\" stroke-linecap=\"butt\" fill=\"none\"");
      part(view, from, to, first ? s : t, 0.2, "stroke=\"#c8321f\" stroke-width=\"3\" fill=\"none\"");
    }
  }
}

void draw_panel(const svg_view& view, const View& moment) {
  const double h = kPostHalf, post[8] = {-h, -h, h, -h, h, h, -h, h};
  std::vector<double> flat;
  for (const Point& p : moment.at) flat.insert(flat.end(), {p[0], p[1]});
  svg_line(&view, flat.data(), moment.at.size(), "stroke=\"#c8321f\" stroke-width=\"3\" fill=\"none\"");
  draw_crossings(view, moment.at);
  svg_polygon(&view, post, 4, "fill=\"#8d99a6\" stroke=\"#5b6773\"");
  std::size_t inserted = 0;
  for (std::size_t i = 0; i < moment.at.size(); ++i) {
    svg_dot(&view, moment.at[i].data(), moment.inserted[i] ? 4 : 1.6,
            moment.inserted[i] ? "fill=\"#ffd33d\" stroke=\"#7a5c00\"" : "fill=\"#3b1d14\"");
    inserted += moment.inserted[i] ? 1 : 0;
  }
  const double title[2] = {-0.5 * kWide + 0.4, 2.4};
  const std::string text = "step " + std::to_string(moment.step) + ", " + std::to_string(moment.at.size()) +
                           " vertices, " + std::to_string(inserted) + " by responses";
  svg_text(&view, title, "font-size=\"17\" fill=\"#333\"", text.c_str());
}

}  // namespace

void draw(const std::vector<View>& moments, const char* directory) {
  const std::size_t rows = (moments.size() + 1) / 2;
  const double width = 2 * kWide * kScale, height = static_cast<double>(rows) * kHigh * kScale;
  svg_view view = {svg_open(directory, "knot.svg", width, height), 0, 0, 0, 0, kScale};
  for (std::size_t i = 0; i < moments.size(); ++i) {
    view.left = (static_cast<double>(i % 2) + 0.5) * kWide * kScale;
    view.top = (static_cast<double>(i / 2) * kHigh + 3.2) * kScale;
    // Each panel hides what the thread of the one beside it sticks out.
    std::fprintf(view.file, "<svg x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" viewBox=\"%g %g %g %g\">\n",
                 static_cast<double>(i % 2) * kWide * kScale, static_cast<double>(i / 2) * kHigh * kScale,
                 kWide * kScale, kHigh * kScale, static_cast<double>(i % 2) * kWide * kScale,
                 static_cast<double>(i / 2) * kHigh * kScale, kWide * kScale, kHigh * kScale);
    draw_panel(view, moments[i]);
    std::fprintf(view.file, "</svg>\n");
  }
  svg_close(view.file);
}

}  // namespace knot
