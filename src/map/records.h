#pragma once
// Room for cells that come and go. Records and shape tables that are left are kept in lists by size and taken again,
// last left first; nothing else moves. In the plane shapes differ by their number of corners alone, so that cells share
// them and none is ever left. A map is made ready for this when it is first changed: before, it has no such tables.

#include "map/map.h"

namespace dsw {

/** Sets up generations, uses of vertices and the tables between cells and records; polyhedra that share shapes get
 * their own. Throws std::bad_alloc or TOO_LARGE with the map as it was. O(n) the first time, O(1) after. */
template <int D>
void make_ready(Map<D>& map);

/** Takes a record of so many units, all words zero; cell_of_unit says kNoCell there. Throws std::bad_alloc, or
 * TOO_LARGE. */
template <int D>
uint32_t take_record(Map<D>& map, uint32_t units);
/** Takes a shape number with a copy of this table, in the plane that of the shape itself if there is one. Throws
 * std::bad_alloc. */
template <int D>
uint32_t take_shape(Map<D>& map, const Array<uint16_t>& table);

/** Makes room for giving back a record and its shape, if it has one of its own: that then cannot fail. What has been
 * taken has its room. */
template <int D>
void reserve_return(Map<D>& map, Cell c);
/** Gives back the record of a cell with its shape, if it has one of its own. */
template <int D>
void give_back(Map<D>& map, Cell c) noexcept;

/** How much there is, free or not. */
struct Room {
  size_t units, shapes, shape_words;
  size_t record_lists, shape_lists;  // of free ones
};
template <int D>
Room room_of(const Map<D>& map) noexcept;

/** Undo takes: with all of them undone, the last one first, and then `shrink`, the map is as it was when `before` was
 * noted. */
template <int D>
void untake_record(Map<D>& map, uint32_t unit, uint32_t units, const Room& before) noexcept;
template <int D>
void untake_shape(Map<D>& map, uint32_t number, const Room& before) noexcept;
template <int D>
void shrink(Map<D>& map, const Room& before) noexcept;

/** Number of 16-bit words of a table. */
template <int D>
uint32_t shape_length(const Map<D>& map, uint32_t number) noexcept;

}  // namespace dsw
