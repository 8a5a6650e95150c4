#pragma once
// A part of one of many bodies, or a particle.

#include "body/simplices.h"

namespace dsw {

/** A vertex, edge or face of a body, or a particle. */
struct Feature {
  enum Kind : uint32_t { kParticle, kVertex, kEdge, kFace };
  Kind kind = kParticle;
  uint32_t owner = 0;  // number of the body
  uint32_t index = 0;

  Feature() = default;
  Feature(Kind k, uint32_t of, uint32_t i) : kind(k), owner(of), index(i) {}
  Feature(uint32_t of, const Simplex& simplex)
      : kind(static_cast<Kind>(static_cast<uint32_t>(kVertex) + static_cast<uint32_t>(simplex.kind))),
        owner(of),
        index(simplex.index) {
    static_assert(kEdge - kVertex == 1 && kFace - kVertex == 2, "the kinds of simplices, in their order");
  }
  bool operator==(const Feature& o) const { return kind == o.kind && owner == o.owner && index == o.index; }
  bool operator<(const Feature& o) const {
    return kind != o.kind ? kind < o.kind : owner != o.owner ? owner < o.owner : index < o.index;
  }
  bool is_point() const { return kind <= kVertex; }
};

/** The simplex of a body that a feature is. */
inline Simplex simplex_of(const Feature& feature) {
  return {static_cast<Simplex::Kind>(feature.kind - Feature::kVertex), feature.index};
}

}  // namespace dsw
