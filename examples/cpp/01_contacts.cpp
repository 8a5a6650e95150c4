// A rod between two vertices falls to the floor of a box; its contacts are read.
#include <dartsweep/dartsweep.hpp>

#include <array>
#include <cstdio>
#include <vector>

int main() {
  const std::vector<std::array<double, 3>> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<int> cell = {0, 1, 2, 3, 4, 5, 6, 7};
  try {
    auto environment = dartsweep::Environment::of(DSW_CELL_TYPE_HEXAHEDRON, corners, cell);
    dartsweep::Scene scene(environment);

    const dsw_flight flight = environment.cast({0.5, 0.25, 0.5}, {0.5, 0.25, -0.5});
    std::printf("a point meets the floor after %g of its way\n", flight.time);

    std::vector<std::array<double, 3>> rod = {{0.2, 0.5, 0.5}, {0.8, 0.5, 0.75}};
    const std::vector<unsigned> edges = {0, 1};
    dartsweep::Body body(scene, scene.create_body(rod, edges));
    for (auto& vertex : rod) vertex[2] -= 1;

    auto options = dartsweep::defaults<dsw_move_options>();
    options.edge_response = DSW_RESPONSE_SLIDE;
    const dsw_move_report report = body.move(rod, &options);
    const auto contacts = body.get_contacts();
    for (const dsw_body_contact& contact : contacts) {
      std::printf("vertex %u at (%g, %g, %g), normal (%g, %g, %g)\n", contact.vertex.index, contact.position[0],
                  contact.position[1], contact.position[2], contact.contact.normal[0], contact.contact.normal[1],
                  contact.contact.normal[2]);
    }
    return flight.time == 0.5 && report.contact_count == contacts.size() && !contacts.empty() ? 0 : 1;
  } catch (const dartsweep::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
