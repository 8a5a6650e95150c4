"""Made-up results in the form of real ones: enough for a page."""
import csv
import json
import math

from read import CURVE_COLUMNS

STABILITY = ("integrator", "stiffness", "dt", "stable", "energy_drift", "energy_largest", "kinetic_largest", "momentum_change",
             "largest_stretch", "contact_stretch", "steps", "contacts", "nonfinite", "refused", "not_free", "lost")
EXTREMES = ("case", "steps", "contacts", "nonfinite", "refused", "not_free", "lost", "largest_coordinate", "goes_on", "what_happened")
PAIRS = ("set", "kind", "method", "queries", "touching", "missed", "invented", "late", "time_error", "time_off_median", "time_off_max", "ns_median",
         "ns_p999", "ns_max")
CONTACTS = ("scene", "integrator", "stiffness", "dt", "mass_ratio", "friction", "aspect", "stable", "cause", "steps", "contacts", "nonfinite",
            "not_free", "lost")
LEFT_OUT = ("feature", "setting", "bytes_per_cell", "bytes_per_vertex", "orientation_tests_per_step", "microseconds_per_step")


def write_rows(path, columns, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(rows)


def curve(name, with_peer, both=True):
    """A dial of six settings, its last one without error, the exact method and perhaps peers; one kind of error or two."""
    rows = []

    def add(method, setting, unit, time, missed, late):
        if missed is not None:
            rows.append((name, method, setting, unit, time, "sweep", "share of contacts missed", missed, "", 20000, "a, \"note\" <b>"))
        if both and late is not None:
            rows.append((name, method, setting, unit, time, "sweep", "time of contact", late, "of the move", 20000, ""))

    for step in range(6):
        error = 0.3 * 8.0**-step if step < 5 else 0.0
        add("dartsweep dial", 2**step, "halvings", 2e-7 * 1.6**step, error, error / 7)
    add("dartsweep exact", "", "", 3e-6, 0, 1.1e-16)
    if with_peer:
        add("Bullet", "margin 0", "", 4e-7, 2e-3, None)
        add("Tight-Inclusion", 1e-6, "tolerance", 4e-5, None if both else 0, 1e-6)
    return rows


def write(folder, curves=8, peers=4):
    """Fills a folder with what the measuring programs would have written."""
    for number in range(curves):
        name = f"curve_{number}"
        write_rows(folder / f"{name}.csv", CURVE_COLUMNS, curve(name, number < peers, number == 0))
        (folder / f"{name}.txt").write_text(f"Take setting {number}: it is < 1 & good.\n", encoding="utf-8")
    grid = []
    for integrator in ("symplectic_euler", "implicit_euler", "xpbd"):
        for stiffness in (0.01, 1, 1e4, 1e12):
            for dt in (1e-5, 1e-3, 1e-1):
                stable = integrator != "symplectic_euler" or stiffness <= 1
                drift = -0.5 if stable else 1e6 * stiffness
                stretch = 0.01 / math.sqrt(stiffness) if stable else 17319.5
                grid.append((integrator, stiffness, dt, int(stable), drift, drift + 1, 1 if stable else 1e9, 1e-16, stretch, stretch,
                             400, 1000, 0, 0, 0, 0))
    write_rows(folder / "stability.csv", STABILITY, grid)
    contacts = []
    for integrator in ("symplectic_euler", "implicit_euler"):
        for stiffness in (0.01, 1, 1e4):
            stable = integrator != "symplectic_euler" or stiffness <= 1
            contacts.append(("posts", integrator, stiffness, 1e-3, 1, 0.3, 1, int(stable), "" if stable else "stiffness or integrator", 60, 120, 0, 0, 0))
    write_rows(folder / "contact_stability.csv", CONTACTS, contacts * 200)
    write_rows(folder / "extremes.csv", EXTREMES,
               [("force_nan", 15, 0, 0, 1, 0, 0, 2.5, 1, "refused: a < b"), ("many_steps", 1e6, 8e6, 0, 0, 0, 0, 8, 1, "moved freely")])
    summary = {"steps": 1e6, "contacts": 1e7, "nonfinite": 0, "refused": 0, "not_free": 0, "lost": 0, "extremes_go_on": 1,
               "symplectic_euler_max_stable_k": 1, "implicit_euler_max_stable_k": 1e12, "xpbd_max_stable_k": 1e12}
    (folder / "stability.json").write_text(json.dumps({"summary": summary, "stability": [], "extremes": []}), encoding="utf-8")
    write_rows(folder / "left_out.csv", LEFT_OUT,
               [("statistics", "off", 32, 40, 120, 3.5), ("statistics", "on", 32, 40, 120, 3.6), ("deforming", "on", 40, "", 300, 9)])
    write_rows(folder / "exact_pairs.csv", PAIRS,
               [("sample queries", "vertex-face", "Dartsweep", 3085, 248, 0, 0, 0, 0, 0, 0, 40, 18000, 22000),
                ("sample queries", "vertex-face", "FCL (Newton)", 3085, 241, 7, 111, 135, 156, 5.5e-17, 9.3e-9, 40, 250, 3000)])
    (folder / "exact_pairs.json").write_text(json.dumps({"pairs.queries": 3085, "pairs.missed": 0}), encoding="utf-8")
