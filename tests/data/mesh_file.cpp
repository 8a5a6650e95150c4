#include "mesh_file.h"

#include <cstdio>
#include <cstdlib>
#include <map>

namespace dsw::oracle {
namespace {

bool is_packed(const std::string& path) { return path.size() > 3 && path.compare(path.size() - 3, 3, ".gz") == 0; }

/// Words of a file, whatever separates them.
class Words {
 public:
  bool load(const std::string& path) {
    const bool packed = is_packed(path);
    std::FILE* file = packed ? popen(("gzip -dc '" + path + "'").c_str(), "r") : std::fopen(path.c_str(), "rb");
    if (file == nullptr) return false;
    char buffer[1 << 16];
    for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text_.append(buffer, n);
    packed ? pclose(file) : std::fclose(file);
    at_ = text_.c_str();
    return !text_.empty();
  }
  bool done() {
    while (*at_ != 0 && static_cast<unsigned char>(*at_) <= ' ') ++at_;
    return *at_ == 0;
  }
  std::string word() {
    if (done()) return {};
    const char* begin = at_;
    while (static_cast<unsigned char>(*at_) > ' ') ++at_;
    return {begin, at_};
  }
  long integer() { return std::strtol(at_, const_cast<char**>(&at_), 10); }
  double real() { return std::strtod(at_, const_cast<char**>(&at_)); }
  bool seek(const char* key) {
    while (!done()) {
      if (word() == key) return true;
    }
    return false;
  }

 private:
  std::string text_;
  const char* at_ = nullptr;
};

bool read_msh(Words& w, Mesh& mesh) {
  if (!w.seek("$Nodes")) return false;
  const long blocks = w.integer(), count = w.integer();
  w.integer();
  w.integer();
  std::map<long, int> index;
  mesh.points.reserve(static_cast<size_t>(count));
  for (long b = 0; b < blocks; ++b) {
    for (int i = 0; i < 3; ++i) w.integer();
    const long n = w.integer();
    for (long i = 0; i < n; ++i) index[w.integer()] = static_cast<int>(mesh.points.size()) + static_cast<int>(i);
    for (long i = 0; i < n; ++i) {
      const double x = w.real(), y = w.real(), z = w.real();
      mesh.points.push_back({x, y, z});
    }
  }
  if (!w.seek("$Elements")) return false;
  const long groups = w.integer();
  for (int i = 0; i < 3; ++i) w.integer();
  static const int corners[] = {0, 2, 3, 4, 4, 8, 6, 5};
  for (long g = 0; g < groups; ++g) {
    const long dimension = w.integer(), tag = w.integer(), type = w.integer(), n = w.integer();
    if (type < 1 || (type > 7 && type != 15)) return false;
    for (long i = 0; i < n; ++i) {
      w.integer();
      std::vector<int> v;
      for (int k = 0; k < (type == 15 ? 1 : corners[type]); ++k) v.push_back(index.at(w.integer()));
      if (dimension != 3) continue;
      if (type == 6) v = {v[0], v[2], v[1], v[3], v[5], v[4]};  // Gmsh's prism is VTK's wedge mirrored
      static const int vtk[] = {0, 0, 0, 0, 10, 12, 13, 14};
      mesh.add_standard(vtk[type], v);
      mesh.regions.push_back(static_cast<int32_t>(tag));
    }
  }
  return true;
}

bool read_vtk(Words& w, Mesh& mesh) {
  if (!w.seek("POINTS")) return false;
  const long points = w.integer();
  w.word();
  for (long i = 0; i < points; ++i) {
    const double x = w.real(), y = w.real(), z = w.real();
    mesh.points.push_back({x, y, z});
  }
  if (!w.seek("CELLS")) return false;
  const long cells = w.integer();
  w.integer();
  std::vector<std::vector<int>> raw(static_cast<size_t>(cells));
  for (auto& r : raw) {
    for (long n = w.integer(); n > 0; --n) r.push_back(static_cast<int>(w.integer()));
  }
  if (!w.seek("CELL_TYPES")) return false;
  w.integer();
  for (auto& r : raw) {
    const int type = static_cast<int>(w.integer());
    if (type != DSW_CELL_TYPE_POLYHEDRON) {
      mesh.add_standard(type, r);
      continue;
    }
    std::vector<Loop> faces(static_cast<size_t>(r[0]));
    size_t at = 1;
    for (Loop& f : faces) {
      const auto n = static_cast<size_t>(r[at++]);
      f.assign(r.begin() + static_cast<std::ptrdiff_t>(at), r.begin() + static_cast<std::ptrdiff_t>(at + n));
      at += n;
    }
    mesh.add_polyhedron(faces);
  }
  if (w.seek("LOOKUP_TABLE")) {
    w.word();
    for (long i = 0; i < cells; ++i) mesh.regions.push_back(static_cast<int32_t>(w.integer()));
  }
  return true;
}

}  // namespace

bool can_unpack([[maybe_unused]] const std::string& path) {
#if defined(_WIN32) || defined(__EMSCRIPTEN__)
  return !is_packed(path);
#else
  return true;
#endif
}

bool read_mesh(const std::string& path, Mesh& mesh, std::string& reason) {
  Words words;
  if (!words.load(path)) {
    reason = "cannot read " + path;
    return false;
  }
  const bool ok = path.find(".vtk") != std::string::npos ? read_vtk(words, mesh) : read_msh(words, mesh);
  if (!ok || mesh.cells.empty()) reason = "no volume mesh in " + path;
  return ok && !mesh.cells.empty();
}

}  // namespace dsw::oracle
