// The arguments of a recorded call as text, for whoever reads a bug report.

#include <cinttypes>
#include <cstdarg>

#include "capi/replay.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

using capi::Arguments;
using capi::Call;

/** Appends text, of which as much is kept as there is room for. */
class Text {
 public:
  Text(char* out, size_t capacity) : out_(out), capacity_(capacity) {}

  __attribute__((format(printf, 2, 3))) void add(const char* format, ...) noexcept {
    va_list arguments;
    va_start(arguments, format);
    const size_t room = size_ < capacity_ ? capacity_ - size_ : 0;
    size_ +=
        static_cast<size_t>(std::max(0, std::vsnprintf(room == 0 ? nullptr : out_ + size_, room, format, arguments)));
    va_end(arguments);
  }
  size_t size() const { return size_; }

 private:
  char* out_;
  size_t capacity_, size_ = 0;
};

void add(Text& text, const dsw_volume_id& id) { text.add(" %u.%u", id.index, id.generation); }
void add(Text& text, const dsw_face_id& id) { text.add(" %u.%u/%u", id.volume, id.generation, id.local); }
void add(Text& text, uint32_t number) { text.add(" %u", number); }
void add(Text& text, double number) { text.add(" %.17g", number); }

template <class T>
void add_items(Text& text, Arguments& a) {
  constexpr size_t kMost = 60;
  const capi::Items<T> items = a.get_items<T>();
  text.add(items.items == nullptr ? " null" : " [");
  for (size_t i = 0; i < items.count && i < kMost; ++i) add(text, items.items[i]);
  if (items.count > kMost) text.add(" ... %zu in all", items.count);
  if (items.items != nullptr) text.add(" ]");
}

void add_struct(Text& text, Arguments& a) {
  const capi::Items<uint32_t> words = a.get_sized();
  text.add(" {");
  for (size_t i = 1; i < words.count; ++i) text.add(" %x", words.items[i]);
  text.add(" }");
}

void add_moved_points(Text& text, Arguments& a) {
  size_t count = 0;
  for (auto v = a.get<uint64_t>(); v != capi::kNullArray; v = a.get<uint64_t>(), ++count) {
    const bool is_told = count < 20;
    if (is_told) text.add(" %" PRIu64 " to (", v);
    for (uint32_t k = 0; k < a.dimension(); ++k) {
      const auto to = a.get<double>();
      if (is_told) text.add(k == 0 ? "%.17g" : " %.17g", to);
    }
    if (is_told) text.add(")");
  }
  text.add("; %zu vertices in all", count);
}

/** Words and letters: i an id of index and generation, f of a volume's part, u an unsigned, d a double, s a struct beyond its size, as words in
 * hexadecimal, r a rigid motion, m points that move; I F U D arrays, B one of bytes, of which only the number is told. Ids are alike in
 * memory. */
const char* format_of(Call call) noexcept {
  switch (call) {
    case Call::kMarkVolumes:
      return "volumes I mark u flags u";
    case Call::kMarkFaces:
      return "faces F mark u";
    case Call::kMarkEdges:
      return "edges F mark u";
    case Call::kMarkVertices:
      return "vertices I mark u";
    case Call::kMarkRegion:
      return "region u mark u flags u";
    case Call::kMarkBetween:
      return "regions u u mark u";
    case Call::kSetTag:
      return "volume i tag u";
    case Call::kAddVolumes:
      return "desc s vertices I points D types B offsets B connectivity B regions U tags U sewn to F";
    case Call::kRemoveVolumes:
      return "volumes I";
    case Call::kSewFaces:
      return "faces F to F";
    case Call::kUnsewFace:
    case Call::kMergeVolumes:
      return "face f";
    case Call::kSplitVolume:
      return "volume i loop I";
    case Call::kMergeFaces:
      return "edge f";
    case Call::kSplitFace:
      return "face f from i to i";
    case Call::kSplitEdge:
      return "edge f at d";
    case Call::kMergeEdges:
    case Call::kCollapseEdge:
      return "edge f vertex i";
    case Call::kCut:
    case Call::kTie:
      return "desc s points D";
    case Call::kTearFaces:
      return "faces F loads D limit d";
    case Call::kOpen:
      return "desc s faces B";
    case Call::kCarve:
      return "desc s points D triangles U";
    case Call::kDetach:
      return "desc s";
    case Call::kRemesh:
      return "desc s volumes I next D";
    case Call::kDeform:
      return "options s vertices m";
    case Call::kCreateParticle:
      return "position D hint i";
    case Call::kCreateParticles:
      return "positions D hints I";
    case Call::kDestroyParticle:
      return "particle i";
    case Call::kMoveParticle:
      return "particle i target D options s";
    case Call::kMoveParticles:
    case Call::kCastFromParticles:
      return "particles I targets D options s";
    case Call::kCreateBody:
      return "desc s positions D hints I edges U face offsets U corners U";
    case Call::kDestroyBody:
      return "body i";
    case Call::kSetLevel:
      return "body i level u";
    case Call::kSetFilter:
      return "body i category u mask u";
    case Call::kAddBodyVertex:
      return "body i position D hint i";
    case Call::kAddBodyEdge:
      return "body i vertices i i";
    case Call::kAddBodyFace:
      return "body i vertices i i i";
    case Call::kRemoveBodyFace:
      return "body i face i";
    case Call::kRemoveBodyEdge:
      return "body i edge i";
    case Call::kRemoveBodyVertex:
      return "body i vertex i";
    case Call::kSplitBodyEdge:
      return "body i edge i at d";
    case Call::kCollapseBodyEdge:
      return "body i edge i vertex i";
    case Call::kMoveBody:
      return "body i targets D options s order U";
    case Call::kMoveBodies:
      return "bodies I targets D options s";
    case Call::kMoveRigid:
      return "body i motion r options s order U";
    case Call::kResetStatistics:
    case Call::kCount:
      return "";
  }
  return "";
}

void add_argument(Text& text, char letter, Arguments& a) {
  switch (letter) {
    case 'i':
      return add(text, a.get<dsw_volume_id>());
    case 'f':
      return add(text, a.get<dsw_face_id>());
    case 'u':
      return add(text, a.get<uint32_t>());
    case 'd':
      return add(text, a.get<double>());
    case 'r':
      for (int k = 0; k < 10; ++k) add(text, a.get<double>());
      return;
    case 's':
      return add_struct(text, a);
    case 'm':
      return add_moved_points(text, a);
    case 'I':
      return add_items<dsw_volume_id>(text, a);
    case 'F':
      return add_items<dsw_face_id>(text, a);
    case 'U':
      return add_items<uint32_t>(text, a);
    case 'D':
      return add_items<double>(text, a);
    default:
      return text.add(" of %zu bytes", a.get_items<uint8_t>().count);
  }
}

void add_arguments(Text& text, const char* format, Arguments a) {
  for (const char* at = format; *at != 0;) {
    const char* end = at;
    while (*end != 0 && *end != ' ') ++end;
    const bool is_letter = end - at == 1;
    if (is_letter) add_argument(text, *at, a);
    if (!is_letter) text.add("%s%.*s", text.size() == 0 ? "" : " ", static_cast<int>(end - at), at);
    at = *end == 0 ? end : end + 1;
  }
}

}  // namespace

dsw_status dsw_replay_describe_next(dsw_replay* replay, char* text, size_t capacity, size_t* size) {
  return capi::guard("dsw_replay_describe_next", [&] {
    dsw_replay& handle = capi::check_handle(replay, "replay");
    capi::require_array(text, capacity, "text");
    capi::require(size, "size");
    std::optional<capi::NextCall> next;
    Text all(text, capacity);
    if (read_next(handle, next)) add_arguments(all, format_of(next->call), next->arguments);
    if (all.size() == 0 && capacity != 0) text[0] = 0;
    *size = all.size() + 1;
  });
}
