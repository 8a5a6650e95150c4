"""What the page calls things: titles of curves, names of peers. A curve that is not listed here is drawn all the same."""

# Longer names first: the first that a method's name contains is its peer.
PEERS = {"tight-inclusion": "Tight-Inclusion", "ipc": "Tight-Inclusion", "embree": "Embree", "bullet": "Bullet", "fcl": "FCL",
         "libccd": "libccd", "mujoco": "MuJoCo"}


def peer_of(method):
    """The library that a method's name belongs to, or an empty string if it is ours."""
    name = method.lower().replace("_", "-")
    return next((peer for key, peer in PEERS.items() if key in name), "")


# What programs write, and how people do.
WORDS = {"symplectic_euler": "symplectic Euler", "implicit_euler": "implicit Euler", "xpbd": "XPBD", "^2": "²"}


def in_words(text):
    for written, read in WORDS.items():
        text = text.replace(written, read)
    return text


def is_exact(method):
    """Whether a method of ours approximates nothing: it says so, or it is the level that sees all there is."""
    return "exact" in method.lower().replace("(", " ").replace(")", " ").split() or method == "dartsweep FACES"


def title_of(curve):
    return CURVES.get(curve, (curve.replace("_", " ").capitalize(), ""))[0]


def about(curve):
    return CURVES.get(curve, ("", ""))[1]


def order(curve):
    """For sorting: curves as they are listed, others behind them by name."""
    return (list(CURVES).index(curve) if curve in CURVES else len(CURVES), curve)


# Curves whose settings all cost the same: drawn against the setting, not against run time.
AGAINST_SETTING = {"omega"}

# Name of the curve: its title, and what is measured.
CURVES = {
    "edge_time": (
        "Bisection depth: time of contact",
        "One end of an edge moves by one cell and touches something; the whole scene is searched, free-standing faces in "
        "a lattice of tetrahedra. How far is the reported time from the exact one, by the exact search and by the dichotomic "
        "search of [JCD10] 4.2, which halves the way, at two levels?"),
    "edge_place": (
        "Bisection depth: place at the contact",
        "The same moves: how far is the moving end, as reported, from where it is at the exact time?"),
    "move_time": (
        "Bisection depth: all moves",
        "The same where moves are a quarter of a cell long and most of them are free: what a move costs, and how far the times "
        "of its contacts are off."),
    "missed_vessel": (
        "Levels in a vessel",
        "A corner of a triangle moves by half an edge. Which share of the contacts of all that the triangle sweeps does "
        "each level miss, at edges of 0.1 to 4 cells? FACES sees all of it. Here in a winding lumen with closed walls."),
    "missed_faces": (
        "Levels among free-standing faces",
        "The same where single faces of the lattice are impassable, so that their rims can be passed."),
    "missed_spikes": (
        "Levels among spikes",
        "The same where single tetrahedra are impassable: corners that fit through a triangle between its edges."),
    "sampling_vessel": (
        "Sampling a catheter, in a vessel",
        "A catheter of 12 cells is given 5 to 199 vertices; its middle moves. Which share of the contacts of what its two "
        "straight halves sweep does each level miss?"),
    "sampling_faces": (
        "Sampling a catheter, among free-standing faces",
        "The same where single faces of the lattice are impassable, so that edges pass rims between two vertices."),
    "elimination": (
        "Elimination by motion",
        "Ropes of 16 edges drift and turn; edges whose ends hardly move against each other are left out up to the share "
        "named, and cast once at the end of the call. What they miss on the way is the error; where they end is free in "
        "any case."),
    "stand_off_gap": (
        "Stand-off: the gap that is kept",
        "A sheet slides pressed on a wall. How far from the wall do its vertices come to lie?"),
    "stand_off_fallbacks": (
        "Stand-off: work for exact arithmetic",
        "The same runs: the share of orientation tests that floating point leaves open. Not an error, but what the gap is "
        "for."),
    "deform_passed": (
        "End state or swept: what walls go over",
        "The vertices of a lattice move by ten cell radii, in steps of 0.01 to 10 radii, through a cloud of particles. "
        "Which share of those that a wall met on its way does the wall go over without touching them?"),
    "deform_pushed": (
        "End state or swept: what is pushed for nothing",
        "The same runs: the share of particles pushed that no wall met."),
    "deform_place": (
        "End state or swept: where what is pushed comes to lie",
        "The same runs: how far from where a particle would be that goes with the wall from the touch on, beside walls that "
        "push by the whole step in which they touch, as version 2.0 did."),
    "deform_way": (
        "End state or swept: what holds the walls",
        "The same lattice moves against bodies with edges, which it must not cut: the share of its way that it did not "
        "make because they held it."),
    "ccd_vertex_face": (
        "Single pairs: a vertex against a triangle",
        "What every library of continuous collision detection is made of, on pairs of which half touch. Whoever sees "
        "nothing goes on to the end of the move, and that is its error. Our exact test decides ties and rounds the time "
        "down; the others do neither."),
    "ccd_edge_edge": (
        "Single pairs: an edge against an edge",
        "The same for an edge of which one end moves, against an edge that stands still. Bullet has no such test."),
    "degenerate_vertex_face": (
        "Degenerate pairs: a vertex against a triangle",
        "Small whole coordinates, ways through corners, middles of sides, and ends that just touch, half of them moved by "
        "one unit in the last place. Wrong is a contact that is missed as well as one that is invented; the notes in the "
        "table tell them apart. Tight-Inclusion promises to miss none and misses none: what is counted here is that it "
        "takes near misses for contacts."),
    "degenerate_edge_edge": (
        "Degenerate pairs: an edge against an edge",
        "The same for an edge of which one end moves, against an edge that stands still."),
    "contact_point": (
        "Contact point",
        "A vertex meets a triangle: how far is the reported point from the exact one? Ours is looked for in the whole "
        "scene, peers get the pair."),
    "contact_normal": (
        "Contact normal",
        "The same pairs: the angle between the reported normal and the exact one."),
    "cast_time": (
        "Casts through a scene: time of contact",
        "Segments of eight cells from random places in a vessel to beyond its wall. Embree and Bullet hold the walls as "
        "triangles in floats; we walk through the cells of the vessel, whose starts are known."),
    "cast_through": (
        "Casts aimed at edges and corners: what passes closed walls",
        "The same vessel, casts aimed at corners and at middles of sides of the wall's triangles, to targets outside of the "
        "lumen. A cast that is not stopped has passed."),
    "time_step": (
        "Time step and order of vertices",
        "Vertices move one at a time, so contacts are true for that motion. A rod turns against a post, vertices in "
        "either order: how far is the first contact from that of all vertices moving at once, and the shape reached from "
        "the limit of both orders?"),
    "integrator": (
        "Integrator and time step",
        "A rope swings with nothing to meet. How far do its points come to lie from a reference solution at a far "
        "smaller step? MuJoCo has the same masses and springs, as slides and tendons."),
    "solver_steps": (
        "Sweeps of XPBD, Newton steps of implicit Euler",
        "Both look for the end of the same implicit step. How far do they stay from it, at three stiffnesses?"),
    "energy_drift": (
        "Stiffness: energy",
        "The rod of the table below tumbles freely at a time step of 1 ms: change of its energy, by stiffness in m/dt². 1 "
        "is all of it."),
    "largest_stretch": (
        "Stiffness: stretch",
        "The same runs: the largest stretch of a link, relative to its length."),
    "shape_matching": (
        "Shape matching",
        "A beam held at one end should be rigid; it sags by what the share of the way to its goals leaves open in a step."),
    "omega": (
        "Shape matching: weight of inserted vertices",
        "A soft body is pressed on a ridge that it lies on by one end; contacts insert vertices. How far is its rotation from "
        "that of the same body with eight times as many vertices along, and what rotation do the inserted vertices add to the "
        "matched shape? [JCD10] 7.3.1 warns of too large a weight."),
}
