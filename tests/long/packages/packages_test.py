"""Makes the Debian packages, unpacks them, and runs what is in them. Usage: packages_test.py CPACK BUILD"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import small_root

CPACK, BUILD = sys.argv.pop(1), Path(sys.argv.pop(1))


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        run(CPACK, "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder / "made", cwd=BUILD)
        cls.packages = {file.name.split("_")[0]: file for file in (cls.folder / "made").glob("*.deb")}
        for name, file in cls.packages.items():
            run("dpkg-deb", "-x", file, cls.folder / name)

    def root(self, *names):
        """These packages together, as an installation has them."""
        root = self.folder / "-and-".join(names)
        if len(names) > 1 and not root.exists():
            for name in names:
                shutil.copytree(self.folder / name, root, dirs_exist_ok=True, symlinks=True)
        return root / "usr"

    def depends(self, name):
        return {word.split()[0] for word in run("dpkg-deb", "-f", self.packages[name], "Depends").split(", ")}

    def libraries(self, file):
        return run("ldd", file)

    def test_are_there(self):
        self.assertLessEqual({"interreflect-cli", "interreflect"}, set(self.packages))
        for file in self.packages.values():
            self.assertIn("Interreflect", run("dpkg-deb", "-f", file, "Description", "Maintainer"))

    def test_command_line_needs_no_qt(self):
        depends = self.depends("interreflect-cli")
        self.assertTrue(any(name.startswith("libembree") for name in depends), depends)
        self.assertTrue(any(name.startswith("libopenimageio") for name in depends), "of the module that is loaded")
        self.assertFalse([name for name in depends if "qt" in name])
        self.assertNotIn("Qt6", self.libraries(self.root("interreflect-cli") / "bin/interreflect-cli"))

    def test_window_needs_both(self):
        depends = self.depends("interreflect")
        self.assertIn("interreflect-cli", depends)
        self.assertTrue(any(name.startswith("libqt6widgets") for name in depends), depends)

    def test_packages_share_no_file(self):
        seen = {}
        for name in self.packages:
            for path in (self.folder / name).rglob("*"):
                if path.is_file():
                    file = path.relative_to(self.folder / name)
                    self.assertNotIn(file, seen, f"{name} and {seen.get(file)}")
                    seen[file] = name
        self.assertFalse([file for file in seen if not file.is_relative_to("usr")])

    def test_command_line_runs_from_its_own_files(self):
        usr = self.root("interreflect-cli")
        program = usr / "bin/interreflect-cli"
        self.assertIn(f"data: {usr}/share/interreflect\n", run(program, "info"))
        arguments = ["render", "--scene", "builtin:cornell", "--method", "ldm-ao", "--size", "48x36"]
        run(program, *arguments, "--out", self.folder / "a.exr")
        run(program, *arguments, "--out", self.folder / "a.png")
        run(BUILD / "bin/interreflect-cli", *arguments, "--out", self.folder / "b.exr")
        self.assertIn("rmse 0\n", run(program, "compare", self.folder / "a.exr", self.folder / "b.exr"))
        sample = usr / "share/interreflect/samples/crevice-leaks.interreflect"
        self.assertIn("ldm-ao", run(program, "project", sample))
        self.assertIn('"title"', run(program, "schema", "statistics"))

    def test_dependencies_suffice(self):
        """In a system of what the package names, and no more, the command line renders by either backend."""
        if os.geteuid() != 0:
            self.skipTest("only root may change its root")
        root = self.folder / "clean"
        package = self.packages["interreflect-cli"]
        relation = run("dpkg-deb", "-f", package, "Depends") + "," + run("dpkg-deb", "-f", package, "Recommends")
        try:
            small_root.make(root, relation.replace("\n", ""))
        except LookupError as missing:
            self.skipTest(str(missing))
        run("dpkg-deb", "-x", package, root)
        if small_root.run(root, "true").returncode != 0:
            self.skipTest("mounts are not allowed here")
        self.assertFalse(list(root.rglob("libQt6*")))
        for backend in ("egl", "osmesa"):
            done = small_root.run(root, "interreflect-cli", "render", "--scene", "builtin:cornell", "--method", "ldm-ao",
                                  "--size", "32x24", "--backend", backend, "--out", f"/tmp/{backend}.png")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater((root / f"tmp/{backend}.png").stat().st_size, 200)

    def test_documents_are_there(self):
        usr = self.root("interreflect-cli")
        for file in ("share/interreflect/REFERENCES.bib", "share/interreflect/docs/projects.md",
                     "share/interreflect/schemas/project.schema.json", "share/interreflect/schemas/sweep.schema.json",
                     "share/doc/interreflect-cli/copyright", "share/man/man1/interreflect-cli.1",
                     "share/bash-completion/completions/interreflect-cli", "share/mime/packages/interreflect-project.xml",
                     "share/thumbnailers/interreflect.thumbnailer"):
            self.assertGreater((usr / file).stat().st_size, 50, file)

    def test_window_starts(self):
        usr = self.root("interreflect-cli", "interreflect")
        self.assertIn("interreflect", run(usr / "bin/interreflect", "--version", env={**os.environ, "QT_QPA_PLATFORM": "offscreen"}))

    def test_desktop_knows_the_window(self):
        usr = self.folder / "interreflect/usr"
        entry = dict(line.split("=", 1) for line in (usr / "share/applications/interreflect.desktop").read_text().splitlines()
                     if "=" in line)
        self.assertTrue((usr / "bin" / entry["Exec"].split()[0]).exists())
        self.assertTrue((usr / f"share/icons/hicolor/scalable/apps/{entry['Icon']}.svg").exists())
        metainfo = usr / "share/metainfo/interreflect.metainfo.xml"
        self.assertIn("<launchable type=\"desktop-id\">interreflect.desktop<", metainfo.read_text())
        if shutil.which("appstreamcli"):
            found = subprocess.run(["appstreamcli", "validate", "--no-net", metainfo], capture_output=True, text=True).stdout
            # The program has no domain after which it could be named.
            faults = [line for line in found.splitlines() if line[:3] in ("E: ", "W: ") and "is-not-rdns" not in line]
            self.assertEqual(faults, [], found)
        if shutil.which("desktop-file-validate"):
            run("desktop-file-validate", usr / "share/applications/interreflect.desktop")

    def test_python_finds_its_module(self):
        if "python3-interreflect" not in self.packages:
            self.skipTest("the module was not built")
        usr = self.root("interreflect-cli", "python3-interreflect")
        text = "import interreflect as ir; print(ir.Experiment('ldm-ao', 'builtin:cornell', size=(16, 12)).render().image.shape)"
        self.assertEqual(run("/usr/bin/python3", "-c", text, env={"PYTHONPATH": usr / "lib/python3/dist-packages", "PATH": "/usr/bin"}).strip(),
                         "(12, 16)")
        self.assertIn("python3-numpy", self.depends("python3-interreflect"))


if __name__ == "__main__":
    unittest.main()
