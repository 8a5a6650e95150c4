#pragma once
// What is in a scene as flat arrays, one for each section of its snapshot: filled from a scene, or read and then turned
// into one.

#include "scene/bodies.h"
#include "snapshot/block.h"

namespace dsw {

/** In format 3 the history of contacts came, in format 4 what edges have touched, in format 5 the radius. */
constexpr uint32_t kHistoryFormat = 3, kTouchedFormat = 4, kRadiusFormat = 5;

struct SceneImage {
  // These arrays belong to the scene. The numbers are the counters of its statistics, then what its environment had of
  // cells, indices and vertices.
  Array<uint64_t> numbers;
  Array<double> particle_places;
  Array<uint32_t> particles;  // cell and forecast
  Array<uint32_t> particle_slots, free_particles;
  Array<uint32_t> body_slots, free_bodies;
  // These arrays belong to the bodies, one after the other.
  Array<uint64_t> bodies;  // see body_format.h
  Array<double> vertex_places;
  Array<uint32_t> vertices;  // cell and first edge
  Array<uint32_t> vertex_slots, free_vertices;
  Array<uint32_t> edges;  // ends, next edges, faces
  Array<uint32_t> edge_slots, free_edges;
  Array<uint32_t> faces;  // corners
  Array<uint32_t> face_slots, free_faces;
  Array<uint32_t> inserted;
  // For each edge twice the count of its facets, plus 1 if they are in rows (corridor/corridor.h); then the cell and local
  // number of each.
  Array<uint32_t> sequences;
  Array<double> balls;         // centre, radius, wanted
  Array<uint32_t> ball_words;  // wait, patience, whether it is of the present environment
  Array<double> contact_places;
  Array<uint32_t> contacts;
  Array<uint32_t> partners;  // one for each contact, if bodies meet each other
  // From version 3 on: what vertices touched before; one of `previous` for each contact.
  Array<double> previous_places;
  Array<uint32_t> previous;
  Array<double> touch_places;
  Array<uint32_t> touches;
  Array<double> shapes;  // of rigid bodies: rotation, centre, translation, rest places
  // From version 4 on: the vertices of what edges have touched, for each edge and end.
  Array<uint32_t> touched;
  // From version 5 on: lengths of edges along thick bodies.
  Array<double> lengths;

  explicit SceneImage(const Memory* memory);

  static constexpr uint32_t kSections = 32, kSectionsBefore[3] = {25, 30, 31};  // of versions 2, 3 and 4

  /** Calls visit(array) for all arrays in the order of their sections. */
  template <class Visit>
  void for_each(Visit visit) {
    visit(numbers);
    visit(particle_places), visit(particles), visit(particle_slots), visit(free_particles);
    visit(body_slots), visit(free_bodies);
    visit(bodies);
    visit(vertex_places), visit(vertices), visit(vertex_slots), visit(free_vertices);
    visit(edges), visit(edge_slots), visit(free_edges);
    visit(faces), visit(face_slots), visit(free_faces);
    visit(inserted);
    visit(sequences);
    visit(balls), visit(ball_words);
    visit(contact_places), visit(contacts), visit(partners);
    visit(previous_places), visit(previous), visit(touch_places), visit(touches);
    visit(shapes);
    visit(touched);
    visit(lengths);
  }
};

constexpr uint32_t kNoIndex = 0xffffffffu;  // for a slot without a cell

/** Public index of a cell, or kNoIndex. */
template <int D>
uint32_t to_index(const Map<D>& map, Cell c) {
  return c.valid() ? map.index(c) : kNoIndex;
}
/** The way back; invalid also for an index without a cell. */
template <int D>
Cell to_cell(const Map<D>& map, uint32_t index) {
  return index < map.index_count() ? map.cell(index) : Cell{};
}

/** Whether something can be at a point in a cell: that is passable and contains it. */
template <int D>
bool can_be_at(const Environment<D>& env, Cell cell, const double* point) noexcept;

/** What is taken of a scene: what a format has, and forecasts or the state alone. */
struct SceneContent {
  uint32_t format;
  bool forecasts;
};

/** Appends a body, or a slot without one. Throws std::bad_alloc. */
template <int D>
void append(const Scene<D>& scene, const BodyRecord<D>& of, const SceneContent& content, SceneImage& image);

/** Takes bodies from an image, which is not trusted: Error with CORRUPT, or std::bad_alloc. */
template <int D>
class BodyReader {
 public:
  /** Reads the bodies of an image that was written in this format. */
  BodyReader(const Environment<D>& env, const SceneImage& image, uint32_t format)
      : env_(env), image_(image), format_(format) {}

  /** The next one, into an empty record; it is sound, in its cells and free at its level. Whether it is apart from
   * other bodies is not looked at. */
  void read(BodyRecord<D>& of);
  /** The next one, which must be empty. */
  void skip();
  /** After the last one: nothing may be left. */
  void finish() const;

 private:
  /** The next `count` elements of an array. */
  template <class T>
  const T* take(const Array<T>& from, size_t& at, uint64_t count);
  SlotPool read_slots(const Array<uint32_t>& words, size_t& at, uint64_t count, const Array<uint32_t>& free,
                      size_t& free_at, uint64_t free_count);
  void read_parts(Body<D>& body, const uint64_t* numbers);
  void read_sequences(Body<D>& body, uint64_t count);
  void read_touched(Body<D>& body, uint64_t count);
  void read_balls(Body<D>& body, uint64_t count);
  void read_contacts(BodyRecord<D>& of, uint64_t count);
  void read_partners(BodyRecord<D>& of, uint64_t count);
  void read_shape(Body<D>& body, uint64_t rest);
  void read_radius(Body<D>& body, const uint64_t* numbers);
  void take_numbers(uint64_t* numbers);
  void read_history(BodyRecord<D>& of, const uint64_t* numbers);
  void let_penetrate(Body<D>& body, const uint64_t* n) const;
  void check(const Body<D>& body);

  const Environment<D>& env_;
  const SceneImage& image_;
  uint32_t format_;
  // Where the next body begins in each array.
  size_t body_ = 0, vertex_place_ = 0, vertex_ = 0, vertex_slot_ = 0, free_vertex_ = 0, edge_ = 0, edge_slot_ = 0,
         free_edge_ = 0, face_ = 0, face_slot_ = 0, free_face_ = 0, inserted_ = 0, sequence_ = 0, ball_ = 0,
         ball_word_ = 0, contact_place_ = 0, contact_ = 0, partner_ = 0, previous_place_ = 0, previous_ = 0,
         touch_place_ = 0, touch_ = 0, shape_ = 0, touched_ = 0, length_ = 0;
};

}  // namespace dsw
