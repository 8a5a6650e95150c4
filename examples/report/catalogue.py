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
AGAINST_SETTING = {"omega", "faces_of_cells"}

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
    "edge_normal": (
        "Bisection depth: the normal",
        "Moves of an edge's end that touch the wall of a lumen, which has steps like stairs: how far is the normal from that of the exact search? "
        "The dichotomic search gives that of the triangle met last or, as in the paper, the mean of the normals of the "
        "walls at its nearest vertex."),
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
    "response": (
        "Responses",
        "Ropes among impassable cubes. Each vertex can go to its target for itself, so only edges are in the way: which share of the ways does "
        "each response leave, in steps of 1/8 to 2 cells?"),
    "min_part": (
        "Least part of an edge", "The same ropes, with one inserted vertex at a contact: an edge gets it if both parts are at least this share. [JCD10] 4.2 takes a quarter."),
    "min_length": ("Least length of an edge", "The same, by the length that both parts must have."),
    "passes": ("Further passes", "The same ropes stop, and those that have stopped are tried again so many times."),
    "max_volumes": ("Work limit of a move", "Long moves through small cells: what a limit of the volumes that a sweep may visit leaves of the way."),
    "query_limit": ("Work limit of casts and swept edges", "The same limit for questions without a scene: those that it ends have no answer."),
    "noise_share": ("Removal of vertices in line", "Ropes are drawn over cubes and back: how far their corners come to lie from where they are if no inserted vertex is removed."),
    "keep_walls": ("Walls that a slide remembers", "Points slide into corners, in one to eight steps: what is left of the way that twenty more slides find."),
    "back_edges": (
        "Eliminations of the paper", "Closed balls fall among cubes and change their shape, at EDGES: contacts that [JCD10] 6.1, 6.2 and 6.3 miss. An edge that is left out is "
        "cast where it arrives."),
    "faces_of_cells": (
        "Faces of a cell", "No dial, but [JCD10] 7.1: particles go up and down columns of prisms. How many orientation tests does a cell take, by the number of its faces?"),
    "together_stop": ("Moves at once: who stops", "Twelve ropes at once: all stop at the first touch, or an island, or what touches, in so many rounds."),
    "together_response": ("Moves at once: response", "The same, with what touches stopping, sliding, or going with the wall."),
    "rigid": ("Rigid motion", "A bar turns by up to 2.5 rad: along exact arcs, and as vertices that go straight in so many steps."),
    "rigid_slide": ("Rigid motion that slides", "A bar slides as a whole, in at most so many further motions."),
    "wall_response": ("What walls do", "An environment waves with ropes in it: the share of the walls' way that is not made, by what they do with what they touch."),
    "wall_min_part": ("Walls that insert: least part", "The same, with vertices inserted into touched edges."),
    "most_halvings": ("Halvings of a deformation", "The same with large waves, in at most 2^k steps."),
    "max_holds": ("Work limit of a deformation", "The same, by how often a vertex may stay in its turn."),
    "invalid_response": ("Volumes that would turn over", "Waves that would make volumes invalid: vertices are held, or all is refused."),
    "remesh": ("Repair of volumes", "Tetrahedra that a deformation would turn over: the share that is not repaired, by rings of neighbours and by faces of a patch."),
    "snap": ("Snap of cuts and carving", "A blade and an octahedron in shaken tetrahedra: how far the cut is from the blade, and points that carving puts on the wrong side."),
    "tie_snap": ("Snap of ties", "A loop is tied: how far the faces that close it are from the loop's surface."),
    "crack_width": ("Width of cracks", "Cracks are opened: the share of vertices that open less, since a volume would become invalid."),
    "coarsen": ("Coarsening", "Tetrahedra are merged into larger volumes: the share that is left, by the faces allowed and by the work allowed. Contacts stay the same."),
    "detach": ("Gap of a detached piece", "A cube becomes a body: how far its vertices are from where they were."),
    "near_margin": ("Margin of near rows", "Contacts of the next step of which no row has told, by the margin in lengths of the step."),
    "contact_response": (
        "Physics: answers to contacts", "A rod falls on posts: rounds of impulses, steps that contacts are kept, and a bound of its vertices, against 64 rounds without both."),
    "negligible": ("Physics: when an inserted vertex goes", "A bar is pressed on a ridge and lifted: its rotation against that with removal at a pull of 1e-6, by the pull that is negligible."),
    "rod": (
        "Physics: the implicit rod", "A wire is pushed along a ring-shaped lumen: linearisations, sweeps, their tolerance, direct solutions between them, and the share of a gap that a step takes back."),
}
