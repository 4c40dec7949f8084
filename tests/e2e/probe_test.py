"""What `heml probe` reads beside the rows themselves, and what it leaves out. HEML_BINARY is the path of the program."""
import unittest

from program import ProgramCase, heml

HEADER = "F11,F12,F13,F21,F22,F23,F31,F32,F33\n"
STATE = "1.2,0.1,0,0,0.9,0,0,0,0.95\n"
LAW = {"law": "mooney_rivlin", "K1": 1500, "K2": 200, "kappa": 1.5e5}


class Probe(ProgramCase):
    def probe(self, material, table):
        """The completed process, and what it wrote."""
        self.write("m.json", material)
        (self.folder / "F.csv").write_bytes(table)
        done = heml("probe", "m.json", "--F", "F.csv", "--out", "P.csv", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done, (self.folder / "P.csv").read_text()

    def test_a_table_may_begin_with_a_byte_order_mark_and_have_the_line_ends_of_windows(self):
        material = {"law": "neo_hookean", "lambda": 3e4, "mu": 4e3}
        plain = self.probe(material, (HEADER + STATE).encode())[1]
        self.assertEqual(plain.count("\n"), 2)
        self.assertEqual(self.probe(material, (HEADER + STATE).encode("utf-8-sig"))[1], plain)
        self.assertEqual(self.probe(material, (HEADER + STATE).replace("\n", "\r\n").encode("utf-8-sig"))[1], plain)

    def test_terms_beside_the_law_are_left_out_and_it_is_told_once(self):
        done, alone = self.probe(LAW, (HEADER + STATE).encode())
        self.assertEqual(done.stderr, "")
        muscle = {"active_stress": 5e4, "fibre": [1, 0, 0]}
        for term in (muscle, {"viscosity": 3}, {"bulk_viscosity": 3}, {"plasticity": {"yield": 1}},
                     {"relaxation": [{"gamma": 0.5, "tau": 1}]}, muscle | {"viscosity": 3}):
            with self.subTest(term=term):
                done, table = self.probe(LAW | term, (HEADER + STATE).encode())
                self.assertEqual(table, alone)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertIn("warning: m.json: the law alone is evaluated, without active stress, viscosity", done.stderr)

    def test_a_folder_in_place_of_the_table_is_refused_as_one_that_cannot_be_read(self):
        self.write("m.json", LAW)
        done = heml("probe", "m.json", "--F", ".", "--out", "P.csv", cwd=self.folder)
        self.assert_refused(done, 3, ".: cannot be read", "F11,F12", alone=True)


if __name__ == "__main__":
    unittest.main()
