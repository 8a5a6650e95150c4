#include "chain.h"

#include "base.h"

static void read_chain(chain *c) {
  require(dsw_body_get_positions(c->scene, c->body, c->positions, kMostLinks, 0, NULL, &c->vertex_count),
          "reading positions", kFailed);
  require(dsw_body_get_edge_indices(c->scene, c->body, c->edges, kMostLinks, &c->edge_count), "reading edges", kFailed);
}

void chain_create(chain *c, dsw_scene *scene, const double *positions, size_t count) {
  uint32_t edges[2 * kMostLinks];
  dsw_body_desc desc;
  size_t i;
  for (i = 0; i + 1 < count; ++i) {
    edges[2 * i] = (uint32_t)i;
    edges[2 * i + 1] = (uint32_t)i + 1;
  }
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = positions;
  desc.vertex_count = count;
  desc.edges = edges;
  desc.edge_count = count - 1;
  c->scene = scene;
  require(dsw_body_create(scene, &desc, &c->body), "creating a chain", kFailed);
  read_chain(c);
}

dsw_move_report chain_move(chain *c, const double *targets, const dsw_move_options *options) {
  dsw_move_report report;
  require(dsw_body_move(c->scene, c->body, targets, c->vertex_count, 0, options, &report), "moving a chain", kFailed);
  read_chain(c);
  return report;
}

size_t chain_count_free(const chain *c) {
  const dsw_environment *environment = dsw_scene_get_environment(c->scene);
  const dsw_volume_id anywhere = {0, 0};
  size_t free_edges = 0, e;
  for (e = 0; e < c->edge_count; ++e) {
    const double *const from = c->positions + 2 * c->edges[2 * e], *const to = c->positions + 2 * c->edges[2 * e + 1];
    dsw_flight flight;
    require(dsw_environment_cast(environment, anywhere, from, to, NULL, &flight), "casting", kFailed);
    free_edges += flight.outcome == DSW_OUTCOME_REACHED;
  }
  return free_edges;
}

void chain_draw(const chain *c, const svg_view *view, const char *style) {
  size_t e;
  for (e = 0; e < c->edge_count; ++e) {
    double ends[4];
    int k;
    for (k = 0; k < 4; ++k) ends[k] = c->positions[2 * c->edges[2 * e + (size_t)k / 2] + (size_t)k % 2];
    svg_line(view, ends, 2, style);
  }
}

void chain_draw_contacts(const chain *c, const svg_view *view, const char *style) {
  const dsw_body_contact *contacts = NULL;
  size_t count = 0, i;
  require(dsw_body_get_contacts(c->scene, c->body, &contacts, &count), "reading contacts", kFailed);
  for (i = 0; i < count; ++i) svg_arrow(view, contacts[i].point, contacts[i].contact.normal, 14, style);
}
