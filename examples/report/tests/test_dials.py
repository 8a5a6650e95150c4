"""The list of dials: every dial of the headers and of the examples' physics has a curve, a test or a question, and every curve a program."""
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import catalogue  # noqa: E402
import dials  # noqa: E402


class Dials(unittest.TestCase):
    def test_none_is_without_a_curve(self):
        self.assertEqual(dials.faults(), [])

    def test_many_are_found(self):
        found = dials.find()
        self.assertGreater(len(found), 120)
        for name in ("dsw_move_options.min_part", "dsw_move_options.edge_response=DSW_RESPONSE_HYBRID", "DSW_MOVE_KEEP_WALLS",
                     "dsw_cut_desc.snap", "RodContactOptions.tolerance", "SoftBodyOptions.negligible"):
            self.assertIn(name, found)

    def test_a_new_dial_is_missed(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "include/dartsweep").mkdir(parents=True)
            (root / "include/dartsweep/new.h").write_text(
                "typedef enum dsw_way {\n  DSW_WAY_LONG = 0,\n  DSW_WAY_FORCE_INT32 = 0x7fffffff\n} dsw_way;\n"
                "typedef struct dsw_new_options {\n  uint32_t struct_size;\n  dsw_way way;\n  double share; /**< New. */\n} dsw_new_options;\n"
                "enum {\n  DSW_MOVE_NEW = 0x4\n};\n", encoding="utf-8")
            self.assertEqual(dials.find(root), ["DSW_MOVE_NEW", "dsw_new_options.share", "dsw_new_options.way=DSW_WAY_LONG"])
            self.assertEqual(len(dials.faults(root, [], {})), 3)
            table = [dials.Dial("DSW_MOVE_NEW", "curve", "new"), dials.Dial("dsw_new_options.share", "curve", "no such curve"),
                     dials.Dial("dsw_new_options.way=DSW_WAY_LONG", "exact", "NoSuchTest"), dials.Dial("gone", "curve", "new")]
            self.assertEqual(len(dials.faults(root, table, {"new": ()})), 3)

    def test_few_are_excused(self):
        excused = [dial for dial in dials.read() if dial.kind == "exact"]
        self.assertLessEqual(len(excused), dials.MOST_EXACT)
        many = [dials.Dial(f"d{i}", "exact", "x") for i in range(dials.MOST_EXACT + 1)]
        self.assertTrue(any("excused" in fault for fault in dials.faults(table=many)))

    def test_every_curve_is_made_by_a_program(self):
        texts = "".join(path.read_text(encoding="utf-8") for folder in ("tests/benchmark/error", "examples/physics")
                        for path in (dials.ROOT / folder).rglob("*") if path.suffix in (".cpp", ".py") and "test" not in path.name)
        for name in catalogue.CURVES:
            parts = (name, *name.rsplit("_", 1))  # some names are put together
            self.assertTrue(any(f'"{part}' in texts or f'{part}"' in texts for part in parts), name)


if __name__ == "__main__":
    unittest.main()
