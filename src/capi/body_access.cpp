#include "capi/body_access.h"

namespace dsw::capi {
namespace {

Skipping to_skipping(uint32_t flags, double share) {
  check_flags(flags,
              DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BY_CLEARANCE |
                  DSW_BODY_SKIP_SIMILAR_MOTION | DSW_BODY_SELF_CONTACTS | DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_RIGID |
                  DSW_BODY_NO_SEQUENCES | DSW_BODY_LEAVE_BACK_EDGES | DSW_BODY_START_PENETRATING,
              "desc->flags");
  if ((flags & DSW_BODY_SEQUENCES) != 0 && (flags & DSW_BODY_NO_SEQUENCES) != 0) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->flags: DSW_BODY_SEQUENCES and DSW_BODY_NO_SEQUENCES exclude each other");
  }
  Skipping skipping;
  skipping.corridors = (flags & DSW_BODY_SEQUENCES) != 0;
  skipping.no_corridors = (flags & DSW_BODY_NO_SEQUENCES) != 0;
  skipping.by_environment = (flags & DSW_BODY_SKIP_BY_ENVIRONMENT) != 0;
  skipping.by_clearance = (flags & DSW_BODY_SKIP_BY_CLEARANCE) != 0;
  skipping.by_similar_motion = (flags & DSW_BODY_SKIP_SIMILAR_MOTION) != 0;
  skipping.back_edges = (flags & DSW_BODY_SKIP_BACK_EDGES) != 0;
  skipping.leaves_back_edges = (flags & DSW_BODY_LEAVE_BACK_EDGES) != 0;
  if (skipping.leaves_back_edges) {
    constexpr uint32_t kOthers = DSW_BODY_SKIP_SIMILAR_MOTION | DSW_BODY_RIGID | DSW_BODY_START_PENETRATING;
    if (!skipping.back_edges || (flags & kOthers) != 0) {
      fail(DSW_STATUS_UNSUPPORTED,
           "desc->flags: DSW_BODY_LEAVE_BACK_EDGES needs DSW_BODY_SKIP_BACK_EDGES, and is for none of "
           "DSW_BODY_SKIP_SIMILAR_MOTION, DSW_BODY_RIGID and DSW_BODY_START_PENETRATING");
    }
  }
  if (to_length(share, "desc->motion_share") != 0) skipping.motion_share = share;
  return skipping;
}

}  // namespace

ContactFilter to_filter(uint32_t category, uint32_t mask, bool self) {
  ContactFilter filter;
  if (category != 0) filter.category = category;
  if (mask != 0) filter.mask = mask;
  filter.self = self;
  return filter;
}

template <int D>
BodyDescription to_description(const Scene<D>& scene, const BodyOptions& options) {
  BodyDescription out;
  out.level = options.level;
  out.skipping = to_skipping(options.flags, options.motion_share);
  if (D == 2 && out.skipping.back_edges) {
    fail(DSW_STATUS_UNSUPPORTED, "DSW_BODY_SKIP_BACK_EDGES in desc->flags: bodies in the plane have no faces");
  }
  const bool self = (options.flags & DSW_BODY_SELF_CONTACTS) != 0;
  if (self || options.category != 0 || options.mask != 0) {
    check_enabled(scene.features.contacts, "DSW_FEATURE_BODY_CONTACTS");
  }
  out.filter = to_filter(options.category, options.mask, self);
  out.rigid = (options.flags & DSW_BODY_RIGID) != 0;
  out.may_penetrate = (options.flags & DSW_BODY_START_PENETRATING) != 0;
  return out;
}

template BodyDescription to_description(const Scene<2>&, const BodyOptions&);
template BodyDescription to_description(const Scene<3>&, const BodyOptions&);

uint32_t to_slot(const SlotPool& slots, uint32_t index, uint32_t generation, const char* name, const char* part) {
  if (slots.alive(index, generation)) return index;
  fail(DSW_STATUS_STALE_ID, "%s {index %u, generation %u} names no %s of the body", name, index, generation, part);
}

}  // namespace dsw::capi
