#include "capi/replay.h"

#include <cinttypes>
#include <cstdarg>

#include "capi/scene_handle.h"
#include "environment/moving.h"
#include "scene/deformation.h"
#include "snapshot/block.h"
#include "snapshot/scene_snapshot.h"
#include "snapshot/snapshot.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw::Entry next_entry(dsw_replay& replay, dsw::EntryKind kind, const char* what) {
  dsw::Entry entry;
  if (!replay.reader.next(&entry)) fail(DSW_STATUS_TRUNCATED, "the recording ends before %s", what);
  if (entry.kind != kind) fail(DSW_STATUS_CORRUPT, "the recording is damaged: no %s where it should be", what);
  return entry;
}

/** What an entry begins with. */
template <class T, size_t N>
void read_words(const dsw::Entry& entry, T (&words)[N], const char* what) {
  if (entry.size < sizeof words) fail(DSW_STATUS_CORRUPT, "the recording is damaged: %s", what);
  std::memcpy(words, entry.bytes, sizeof words);
}

/** Vertices for which there is memory where the host had room for `room`: recordings are not trusted, so there is as
 * much as calls have needed. 0: its points were not to be written. */
size_t made_room(const dsw_replay& replay, uint64_t room) noexcept {
  constexpr size_t kSpare = 1024;
  const size_t vertices =
      capi::visit(*replay.environment, [](const auto& env) { return size_t{env.map.vertex_count}; });
  const size_t made = std::max(replay.needed_room, 2 * vertices + kSpare);
  return room < made ? static_cast<size_t>(room) : made;
}

/** The environment reads one of our arrays as if the host had lent it. */
void lend(dsw_replay& replay, dsw::Array<double>& points) noexcept {
  capi::visit(*replay.environment, [&](auto& env) {
    env.points = points.data();
    env.point_room = made_room(replay, replay.watch.room);
    env.lent = env.point_room == 0 ? nullptr : points.data();
  });
}

void lend_points(dsw_replay& replay, uint64_t room) {
  capi::visit(*replay.environment, [&](auto& env) {
    constexpr size_t D = capi::kDimension<decltype(env)>;
    const size_t count = env.map.vertex_count;
    if (room != 0 && room < count) fail(DSW_STATUS_CORRUPT, "the recording is damaged: points");
    replay.watch.room = room;
    replay.points[0].resize(D * std::max(count, made_room(replay, room)));
    std::copy_n(env.points, D * count, replay.points[0].data());
    lend(replay, replay.points[0]);
    release_owned_points(env);
  });
}

/** Whether the host's points had more room than ours. */
bool lacks_room(const dsw_replay& replay) {
  const uint64_t room = std::max(replay.watch.room, replay.watch.offered);
  return made_room(replay, room) < room;
}

void make_room(dsw_replay& replay) {
  replay.needed_room = 2 * made_room(replay, std::max(replay.watch.room, replay.watch.offered));
  const double* const lent = capi::visit(*replay.environment, [](const auto& env) { return env.lent; });
  if (lent == nullptr) return;
  dsw::Array<double>& points = replay.points[lent == replay.points[0].data() ? 0 : 1];
  points.resize((capi::is_planar(*replay.environment) ? 2 : 3) * made_room(replay, replay.watch.room));
  lend(replay, points);
}

void load_beginning(dsw_replay& replay) {
  uint32_t maker[2];
  read_words(next_entry(replay, dsw::EntryKind::kMaker, "its maker"), maker, "its maker");
  replay.version = maker[0];
  replay.flags = maker[1];
  const dsw::Entry first = next_entry(replay, dsw::EntryKind::kEnvironment, "its environment");
  uint64_t lending[2];
  read_words(first, lending, "its environment");
  replay.environment =
      capi::load_environment(replay.context, first.bytes + sizeof lending, first.size - sizeof lending);
  const dsw::Entry second = next_entry(replay, dsw::EntryKind::kScene, "its scene");
  replay.scene = capi::load_scene(*replay.environment, second.bytes, second.size);
  replay.scene->watch = &replay.watch;
  replay.watch.state_format = dsw::saved_version(second.bytes);
  if (lending[0] != 0) lend_points(replay, lending[1]);
}

/** What the host has said, at the end of a bug report. */
const char* read_note(const dsw::Entry& entry) {
  if (entry.size == 0 || entry.bytes[entry.size - 1] != 0)
    fail(DSW_STATUS_CORRUPT, "the recording is damaged: its note");
  return reinterpret_cast<const char*>(entry.bytes);
}

void read_end_of_bug_report(dsw_replay& replay, const dsw::Entry& entry) {
  if (entry.kind == dsw::EntryKind::kNote) {
    replay.note = read_note(entry);
    return;
  }
  replay.words.resize(entry.size / sizeof(uint64_t));
  std::memcpy(replay.words.data(), entry.bytes, entry.size);
  replay.validation = capi::WordReader(replay.words).get_struct<dsw_validation>();
  replay.validation->text[sizeof replay.validation->text - 1] = 0;
}

/** The result of a call, if there is one, and whether the call was then made again with more room. */
bool read_result(dsw::RecordReader& reader, capi::CallResult* result) {
  dsw::Entry entry;
  if (!reader.next(&entry)) return false;
  const size_t count = entry.size / sizeof(uint64_t);
  if (entry.kind != dsw::EntryKind::kResult || (count != capi::kResultWords && count != capi::kMostResultWords)) {
    fail(DSW_STATUS_CORRUPT, "the recording is damaged: no result where it should be");
  }
  uint64_t words[capi::kMostResultWords] = {};
  std::memcpy(words, entry.bytes, entry.size);
  *result = {true, words[0] != 0, count == capi::kMostResultWords, words[1], words[2]};
  return true;
}

/** The first version that writes the results of today, and the first one whose walls push as today's do and whose rigid
 * moves follow their arcs. */
constexpr uint32_t kFirstComparable = 2000000, kFirstOfTodaysWays = 2001000;

/** Tells whether walls have just touched something in dsw_environment_deform, and perhaps pushed it: results and states
 * of a version that pushed it farther are others from here on. */
template <class Row, class Given>
bool has_pushed(const dsw_replay& replay, const Row&, const Given& given) {
  if constexpr (std::is_same_v<Row, std::decay_t<decltype(capi::row_of<dsw_environment_deform>)>>) {
    const dsw_deform_options* const options = capi::get<3>(given);
    const bool may_push =
        options == nullptr || (options->method == DSW_DEFORM_SWEPT &&
                               (options->response == DSW_WALL_PUSH || options->response == DSW_WALL_INSERT));
    return may_push && capi::visit(*replay.scene, [](const auto& engine) {
             const auto* const deformation = engine.deformation.get();
             // A try in fewer steps can have pushed as well.
             return deformation != nullptr && (!deformation->record.contacts.empty() || deformation->record.steps > 1);
           });
  }
  return false;
}

/** DSW_DIFFERS_... between a call and what was recorded of it. */
uint32_t what_differs(const capi::CallResult& recorded, const dsw_replay& replay) {
  const capi::CallResult& now = replay.watch.last;
  const bool failed = !now.made || now.failed;
  uint32_t differs = 0;
  if (replay.goes_otherwise) return 0;
  if (failed != recorded.failed) return DSW_DIFFERS_STATUS;
  if (!failed && replay.version >= kFirstComparable && now.digest != recorded.digest) differs |= DSW_DIFFERS_RESULTS;
  if (recorded.has_state && now.has_state && now.state != recorded.state) differs |= DSW_DIFFERS_STATE;
  return differs;
}

}  // namespace

namespace dsw::capi {

void* keep_bytes(dsw_replay& replay, size_t size) {
  return replay.kept.emplace_back((size + 7) / 8, 0u, replay.words.get_allocator()).data();
}

void Text::add(const char* format, ...) noexcept {
  va_list arguments;
  va_start(arguments, format);
  const size_t room = size_ < capacity_ ? capacity_ - size_ : 0;
  const int length = std::vsnprintf(room == 0 ? nullptr : out_ + size_, room, format, arguments);
  size_ += static_cast<size_t>(std::max(0, length));
  va_end(arguments);
}

void Text::print(const dsw_rigid_motion& motion) noexcept {
  for (const double number : motion.rotation) print(number);
  for (const double number : motion.centre) print(number);
  for (const double number : motion.translation) print(number);
}

void Text::print_words(const Items<uint32_t>& words) noexcept {
  add(" {");
  for (size_t i = 1; i < words.count; ++i) add(" %x", words.items[i]);
  add(" }");
}

double* read_moved_points(WordReader& from, dsw_replay& replay, size_t& room, size_t& count) {
  return visit(*replay.environment, [&](const auto& env) {
    constexpr size_t D = kDimension<decltype(env)>;
    count = env.map.vertex_count;
    Array<double>& next = replay.points[env.points == replay.points[0].data() ? 1 : 0];  // that it does not read
    replay.watch.offered = room;
    room = made_room(replay, room);
    next.resize(D * std::max(count, room));
    std::copy_n(env.points, D * count, next.data());
    for (auto v = from.get<uint64_t>(); v != kNullArray; v = from.get<uint64_t>()) {
      WordReader::require(v < count);
      for (size_t k = 0; k < D; ++k) next[D * static_cast<size_t>(v) + k] = from.get<double>();
    }
    replay.next = next.data();
    return next.data();
  });
}

void print_moved_points(WordReader& from, Text& text) {
  size_t count = 0;
  for (auto v = from.get<uint64_t>(); v != kNullArray; v = from.get<uint64_t>(), ++count) {
    const bool is_told = count < 20;
    if (is_told) text.add(" %" PRIu64 " to (", v);
    for (uint32_t k = 0; k < from.dimension(); ++k) {
      const auto to = from.get<double>();
      if (is_told) text.add(k == 0 ? "%.17g" : " %.17g", to);
    }
    if (is_told) text.add(")");
  }
  text.add("; %zu vertices in all", count);
}

bool read_next(dsw_replay& replay, std::optional<NextCall>& next) {
  Entry entry;
  for (;;) {
    RecordReader reader = replay.reader;
    if (!reader.next(&entry)) return false;
    if (entry.kind == EntryKind::kNote || entry.kind == EntryKind::kValidation) {
      read_end_of_bug_report(replay, entry);
      replay.reader = reader;
      continue;
    }
    if (entry.kind != EntryKind::kCall)
      fail(DSW_STATUS_CORRUPT, "the recording is damaged: no call where it should be");
    const Entry call = entry;
    CallResult result;
    const bool is_finished = read_result(reader, &result);
    RecordReader beyond = reader;
    if (is_finished && beyond.next(&entry) && entry.kind == EntryKind::kRepeated) {
      replay.reader = beyond;
      continue;
    }
    replay.words.resize(call.size / sizeof(uint64_t));
    std::memcpy(replay.words.data(), call.bytes, call.size);
    replay.kept.clear();
    WordReader arguments(replay.words, is_planar(*replay.environment) ? 2 : 3);
    const auto number = arguments.get<uint64_t>();
    const bool is_known = visit_row(number, [&](const auto& row) {
      next.emplace(NextCall{row.number, row.name, arguments, is_finished, result, reader});
    });
    if (is_known) return true;
    fail(DSW_STATUS_CORRUPT, "the recording has call number %llu, which this version does not know",
         static_cast<unsigned long long>(number));
  }
}

/** Makes a call again, with the arguments that were recorded. */
template <class Row>
static dsw_status make(dsw_replay& replay, const Row& row, const WordReader& arguments) {
  auto given = row.read(arguments, replay);
  auto*& handle = get<0>(given);
  if constexpr (std::is_same_v<decltype(handle), dsw_scene*&>) {
    handle = replay.scene;
  } else {
    handle = replay.environment;
  }
  const dsw_status status = given.apply(Row::Function::value);
  if (replay.version < kFirstOfTodaysWays && status == DSW_STATUS_OK && has_pushed(replay, row, given)) {
    replay.goes_otherwise = true;
  }
  return status;
}

void make_again(dsw_replay& replay, const NextCall& next, dsw_replay_report* report) {
  replay.watch.wants_state = next.result.has_state && replay.watch.state_format >= kOldestStateFormat;
  for (;;) {
    replay.watch.last = CallResult{};
    replay.watch.offered = 0;
    replay.next = nullptr;
    visit_row(next.number, [&](const auto& row) { report->status = make(replay, row, next.arguments); });
    const double* const points = visit(*replay.environment, [](const auto& env) { return env.points; });
    if (points == replay.next) replay.watch.room = replay.watch.offered;
    if (report->status != DSW_STATUS_BORROWED || !lacks_room(replay)) break;
    // Whoever makes that again is to pass over it.
    if (replay.scene->recording != nullptr) replay.scene->recording->writer.write(EntryKind::kRepeated, "", 0);
    make_room(replay);
  }
  const bool is_rigid_move = next.number == row_of<dsw_body_move_rigid>.number;
  if (replay.version < kFirstOfTodaysWays && is_rigid_move) replay.goes_otherwise = true;
  const uint32_t differs = next.is_finished ? what_differs(next.result, replay) : 0;
  report->has_failed = next.result.failed ? 1u : 0u;
  report->differs = differs;
  report->outcome = !next.is_finished ? DSW_REPLAY_UNFINISHED : differs == 0 ? DSW_REPLAY_SAME : DSW_REPLAY_DIFFERENT;
  replay.reader = next.after;
  ++replay.calls;
}

}  // namespace dsw::capi

dsw_replay::dsw_replay(dsw_context* owner, const uint8_t* bytes, size_t size)
    : context(owner),
      reader(bytes, size),
      words(capi::memory_of(owner)),
      kept(capi::memory_of(owner)),
      points{dsw::Array<double>(capi::memory_of(owner)), dsw::Array<double>(capi::memory_of(owner))} {
  capi::retain(owner);
}

dsw_replay::~dsw_replay() {
  if (scene != nullptr) {
    capi::detach(*scene);
    capi::destroy_scene(scene);
  }
  if (environment != nullptr) capi::destroy_environment(environment);
  capi::release(context);
}

dsw_status dsw_replay_create(dsw_context* context, const void* recording, size_t size_bytes, dsw_replay** replay) {
  return capi::guard(__func__, [&] {
    capi::check_context(context);
    dsw::require(recording, "recording");
    dsw::require_array(recording, size_bytes, 1, "recording");
    dsw::require(replay, "replay");
    capi::ReplayOwner made(capi::create_object<dsw_replay>(capi::memory_of(context), context,
                                                           static_cast<const uint8_t*>(recording), size_bytes));
    load_beginning(*made);
    *replay = made.release();
  });
}

dsw_status dsw_replay_destroy(dsw_replay* replay) {
  return capi::guard(__func__, [&] {
    if (replay == nullptr) return;
    dsw_replay& handle = capi::check_handle(replay);
    const uint32_t scenes = capi::scene_count(*handle.environment);
    if (scenes != 1) fail(DSW_STATUS_IN_USE, "%u scenes use the environment of the replay", scenes);
    capi::DestroyReplay()(replay);
  });
}

dsw_status dsw_replay_get_scene(const dsw_replay* replay, dsw_scene** scene) {
  return capi::guard(__func__, [&] {
    const dsw_replay& handle = capi::check_handle(replay);
    dsw::require(scene, "scene");
    *scene = handle.scene;
  });
}

dsw_status dsw_replay_get_info(const dsw_replay* replay, dsw_replay_info* info) {
  return capi::guard(__func__, [&] {
    const dsw_replay& handle = capi::check_handle(replay);
    capi::give_struct(info, "info",
                      dsw_replay_info{0, handle.flags, handle.version, 0, handle.calls, handle.reader.left(),
                                      handle.note, handle.validation ? &*handle.validation : nullptr});
  });
}

dsw_status dsw_replay_step(dsw_replay* replay, dsw_replay_report* report) {
  return capi::guard(__func__, [&] {
    dsw_replay& handle = capi::check_handle(replay);
    dsw::require(report, "report");
    *report = capi::step(handle, [](const capi::NextCall&) {});
  });
}

dsw_status dsw_replay_describe_next(dsw_replay* replay, char* text, size_t capacity, size_t* size) {
  return capi::guard(__func__, [&] {
    dsw_replay& handle = capi::check_handle(replay);
    dsw::require_array(text, capacity, "text");
    dsw::require(size, "size");
    std::optional<capi::NextCall> next;
    capi::Text all(text, capacity);
    if (read_next(handle, next)) {
      capi::visit_row(next->number, [&](const auto& row) { row.describe(next->arguments, all); });
    }
    if (all.size() == 0 && capacity != 0) text[0] = 0;
    *size = all.size() + 1;
  });
}
