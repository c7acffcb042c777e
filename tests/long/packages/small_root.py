"""A root folder with nothing but what some Debian packages bring, made of the files of this system."""
import os
import shutil
import subprocess
from pathlib import Path

ESSENTIAL = "Essential"
FIELDS = ("Package", "Architecture", "Status", "Depends", "Pre-Depends", "Provides", ESSENTIAL)


def names_in(relation):
    """Of "a (>= 1) | b, c:any": [["a", "b"], ["c"]]."""
    return [[word.split()[0].split(":")[0] for word in alternatives.split("|")]
            for alternatives in relation.split(",") if alternatives.strip()]


class System:
    """The packages that are installed here."""

    def __init__(self):
        form = "\x01".join(f"${{{field}}}" for field in FIELDS) + "\x02"
        text = subprocess.run(["dpkg-query", "-W", "-f", form], capture_output=True, text=True, check=True).stdout
        self.packages, self.providers = {}, {}
        for record in text.split("\x02"):
            values = dict(zip(FIELDS, record.strip("\n").split("\x01")))
            if len(values) != len(FIELDS) or not values["Status"].endswith(" installed"):
                continue
            self.packages[values["Package"]] = values
            for name in (name for names in names_in(values["Provides"]) for name in names):
                self.providers.setdefault(name, values["Package"])

    def chosen(self, alternatives):
        for name in alternatives:
            name = name if name in self.packages else self.providers.get(name)
            if name:
                return name
        raise LookupError(f"none of {alternatives} is installed here")

    def closure(self, relation):
        """All that an installation of what the relation names has."""
        essential = [name for name, values in self.packages.items() if values[ESSENTIAL] == "yes"]
        waiting, known = [self.chosen(names) for names in names_in(relation)] + essential, set()
        while waiting:
            name = waiting.pop()
            if name in known:
                continue
            known.add(name)
            values = self.packages[name]
            for field in ("Depends", "Pre-Depends"):
                waiting += [self.chosen(names) for names in names_in(values[field])]
        return known

    def files_of(self, package):
        for name in (package, f"{package}:{self.packages[package]['Architecture']}"):
            listing = Path("/var/lib/dpkg/info") / f"{name}.list"
            if listing.exists():
                return [Path(line) for line in listing.read_text().splitlines() if line != "/."]
        raise LookupError(f"the files of {package} are not known")


def alternatives():
    """Links that packages make when they are configured."""
    for entry in Path("/var/lib/dpkg/alternatives").iterdir():
        lines = entry.read_text().split("\n\n")[0].splitlines()
        yield from (Path(line) for line in lines[1:] if line.startswith("/"))


def put(root, path):
    target = root / path.relative_to("/")
    if target.exists() or target.is_symlink() or not (path.is_file() or path.is_symlink()):
        if path.is_dir() and not path.is_symlink():
            target.mkdir(parents=True, exist_ok=True)
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    if path.is_symlink():
        target.symlink_to(os.readlink(path))
        return
    try:
        os.link(path, target)
    except OSError:
        shutil.copy2(path, target)


def make(root, relation):
    root.mkdir()
    for name in ("bin", "sbin", "lib", "lib32", "lib64", "libx32"):
        if Path("/", name).is_symlink():
            (root / "usr" / name).mkdir(parents=True, exist_ok=True)
            (root / name).symlink_to(f"usr/{name}")
    system = System()
    for package in system.closure(relation):
        for path in system.files_of(package):
            put(root, path)
    for path in alternatives():
        if path.is_symlink():
            put(root, path)
            put(root, Path(os.readlink(path)))
    for name in ("proc", "dev", "tmp"):
        (root / name).mkdir(exist_ok=True)
    subprocess.run(["ldconfig", "-r", root], check=True)


def run(root, *words):
    """Inside; needs the rights of root."""
    script = 'mount --bind /proc "$0/proc" && mount --bind /dev "$0/dev" && exec chroot "$0" "$@"'
    return subprocess.run(["unshare", "--mount", "sh", "-c", script, root, *words], capture_output=True, text=True,
                          env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/tmp"})
