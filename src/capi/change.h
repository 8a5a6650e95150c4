#pragma once
// What all functions share that change the topology of an environment.

#include <optional>

#include "capi/recorded.h"
#include "capi/scene_handle.h"
#include "scene/change.h"

namespace dsw::capi {

/** One call: a change of an environment that no more than one scene uses. */
template <int D>
class Change : public Site<D> {
 public:
  static constexpr int kDimension = D;

  /** `out` may be null. Throws SHARED. */
  Change(dsw_environment& handle, Environment<D>& engine, dsw_change* out)
      : Change(handle, engine, only_scene(handle), out) {}

  const Map<D>& map() const { return this->env.map; }
  const Memory* memory() const { return this->env.memory; }
  template <class T>
  Array<T> array(size_t count) const {
    return Array<T>(count, T{}, memory());
  }

  /** The arguments have been checked: the call is written if the scene is recorded. */
  template <class Row, class... Arguments>
  void record(const Row& row, const Arguments&... arguments) {
    this->env.map.begin_call();
    call_.emplace(host_, row, arguments...);
  }
  /** The change has been made. */
  void tell() {
    this->env.map.keep_tables();
    call_->done(this->results);
    if (out_ != nullptr) write_struct(out_, this->results.change());
  }

  /** Records the call, as record() does, for a change that is written here as an edit; returns the empty edit. */
  template <class Row, class... Arguments>
  Edit<D>& begin(const Row& row, const Arguments&... arguments) {
    record(row, arguments...);
    return edit_.emplace(this->env);
  }
  void carry_out() {
    edit_->prepare();
    this->change(*edit_, {});
    tell();
  }
  /** What has come of a draft. */
  dsw_volume_id volume(size_t draft) const { return volume_id(map(), edit_->cell(draft)); }
  dsw_face_id face(size_t draft, uint32_t facet) const {
    return face_id(map(), canonical(map(), edit_->half_facet(draft, facet)));
  }
  dsw_edge_id edge(size_t draft, uint32_t a, uint32_t b) const {
    Dart d{edit_->cell(draft), 0};
    while (dart_vertex(map(), d) != a || dart_target(map(), d) != b) ++d.local;
    return edge_id(map(), d);
  }

 private:
  Change(dsw_environment& handle, Environment<D>& engine, dsw_scene* host, dsw_change* out)
      : Site<D>{engine, engine_of(host, engine), handle.results}, host_(host), out_(out) {
    if (out != nullptr) check_size(out, "change");
  }

  dsw_scene* host_;  // null: nobody looks on
  dsw_change* out_;
  std::optional<Recorded> call_;
  std::optional<Edit<D>> edit_;
};

/** Runs the body of the entry point named `function` with the change that it is to make. `out` may be null. */
template <class Body>
dsw_status guarded_change(const char* function, dsw_environment* environment, dsw_change* out,
                          const Body& body) noexcept {
  return guarded_visit(function, environment, [&](auto& env) {
    Change<kDimension<decltype(env)>> change(*environment, env, out);
    body(change);
  });
}
/** Runs the body of an entry point as guarded_change does, and refuses an environment of the plane. `instead`: null, or
 * the function for sides of the plane, which are faces without edges inside. */
template <class Body>
dsw_status guarded_change_of_space(const char* function, dsw_environment* environment, const char* instead,
                                   dsw_change* out, const Body& body) noexcept {
  return guard(function, [&] {
    if (is_planar(check_handle(environment)) && instead != nullptr) {
      fail(DSW_STATUS_UNSUPPORTED, "in the plane a face is a side, which has no edges inside: see %s", instead);
    }
    Change<3> change(*environment, space(*environment), out);
    body(change);
  });
}

/** The share of an edge's length within which a vertex stands for a crossing; throws unless it is allowed. */
inline double to_snap(double given) { return to_quarter(given, CutSettings().snap, "desc->snap"); }

}  // namespace dsw::capi
