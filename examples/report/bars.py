"""The figures at the top of the page, and what they have to reach."""
from dataclasses import dataclass

LEAST_CURVES, LEAST_POINTS, LEAST_CURVES_WITH_PEERS, LEAST_STABLE_STIFFNESS = 8, 5, 4, 1e12
LEAST_CONTACT_ROWS = 1000


@dataclass(frozen=True)
class Bar:
    key: str
    about: str
    value: float
    bar: str
    met: bool


def check(curves, grid, extremes, summary, pairs=(), dials_without_curve=0, contacts=(), quick=False):
    """Each figure with its bar. The promises are counted anew from the rows: a summary that says less is not believed."""
    least_points = min(curve.setting_count for curve in curves)
    with_peers = sum(bool(curve.peers) for curve in curves)
    bars = [
        Bar("report.curves", "curves of error against run time", len(curves), f"at least {LEAST_CURVES}", len(curves) >= LEAST_CURVES),
        Bar("report.points_least", "measured settings on the curve with the fewest", least_points, f"at least {LEAST_POINTS}",
            least_points >= LEAST_POINTS),
        Bar("report.curves_with_peers", "curves with other libraries beside ours", with_peers, f"at least {LEAST_CURVES_WITH_PEERS}",
            with_peers >= LEAST_CURVES_WITH_PEERS),
    ]
    bars.append(Bar("report.dials_without_curve", "dials without a curve, a test or a question", dials_without_curve, "0", dials_without_curve == 0))
    if pairs:
        ours = [row for row in pairs if row["method"] == "Dartsweep"]
        wrong = sum(row["missed"] + row["invented"] + row["time_error"] for row in ours)
        bars.append(Bar("pairs.wrong", f"answers, of {sum(row['queries'] for row in ours):,.0f} on moving pairs, that are not exact", wrong, "0",
                        wrong == 0))
    if contacts:
        least = LEAST_CONTACT_ROWS // 5 if quick else LEAST_CONTACT_ROWS
        touching = sum(row["contacts"] >= 100 for row in contacts)
        broken = sum(row[name] for row in contacts for name in ("nonfinite", "not_free", "lost"))
        bars += [Bar("stability.rows", "rows of stability in contact, each with at least 100 contacts", touching, f"at least {least:,}", touching >= least),
                 Bar("stability.contact_broken", "numbers that are none, edges not free and vertices lost in these rows", broken, "0", broken == 0)]
    words = {"nonfinite": "steps after which a position or velocity was no number", "not_free": "edges that met something, over all steps",
             "lost": "vertices outside of their recorded volume, over all steps"}
    for name, about in words.items():
        value = max(summary[name], sum(row[name] for row in grid) + sum(row[name] for row in extremes))
        bars.append(Bar(f"stability.{name}", about, value, "0", value == 0))
    stiffness = summary["implicit_euler_max_stable_k"]
    bars.append(Bar("stability.implicit_max_stable_k", "stiffness (m / dt²) up to which implicit Euler is stable at every time step",
                    stiffness, f"at least {LEAST_STABLE_STIFFNESS:.0e}", stiffness >= LEAST_STABLE_STIFFNESS))
    going_on = sum(bool(row["goes_on"]) for row in extremes)
    bars.append(Bar("stability.extremes_going_on", f"extreme cases, of {len(extremes)}, after which the scene goes on", going_on,
                    f"all {len(extremes)}", going_on == len(extremes)))
    return bars
