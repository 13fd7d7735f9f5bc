"""What ./collektive says of tools that are missing or too old."""
import os
import shutil
import subprocess
import tempfile
import unittest

from places import ROOT


class TheTools(unittest.TestCase):
    """What ./collektive says of tools that are missing or too old. Fakes of them lie on the PATH."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="collektive-test-")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def wanting(self, tool, told, packages=()):
        """Runs the check of all tools with one that tells `told` as its version, or nothing, where apt has `packages` (lines of name and version)."""
        apt_cache = "".join(f"[ $2 != {name} ] || echo '  Candidate: {version}'\n" for name, version in packages)
        self.fake(tool, told and f"echo '{told}'")
        self.fake("apt-cache", apt_cache)
        return self.set_up(may_install=False)

    def fake(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(f"#!/bin/sh\n{text or 'exit 1'}\n")
        os.chmod(self.path(name), 0o755)
        # The other command that will do: this system may have it.
        if name == "cargo":
            self.fake("cargo-1.85", None)

    def set_up(self, may_install):
        script = f"""set -euo pipefail; for part in lib setup; do . "$ROOT/scripts/$part.sh"; done; BUILD=$1
            may_install() {{ {str(may_install).lower()}; }}
            setup_system"""
        return subprocess.run(["bash", "-c", script, "bash", self.folder], capture_output=True, text=True,
                              env={**os.environ, "ROOT": ROOT, "PATH": f"{self.folder}:{os.environ['PATH']}"})

    def test_a_tool_that_is_too_old_is_named_with_its_version_and_its_package(self):
        result = self.wanting("cargo", "cargo 1.65.0", [("cargo", "0.66.0+ds1-1"), ("cargo-web", "1.85.0+dfsg3-1~deb12u3")])
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"{self.path('cargo')} is of version 1.65.0; needed is 1.85 or newer", result.stderr)
        self.assertTrue(result.stderr.rstrip().endswith("apt-get install cargo-web"), result.stderr)

    def test_the_package_is_one_that_is_new_enough(self):
        for packages, expected in [([("cargo", "1.85.1+dfsg1-1+deb13u1"), ("cargo-web", "1.96.0")], "cargo"),
                                   ([("cargo", "1.75.0"), ("cargo-1.85", "1.85.1+dfsg0")], "cargo-1.85"), ([], "cargo")]:
            result = self.wanting("cargo", "cargo 1.75.0", packages)
            self.assertTrue(result.stderr.rstrip().endswith(f"apt-get install {expected}"), result.stderr)

    def test_on_a_fresh_system_the_package_is_chosen_when_apt_has_its_lists(self):
        self.fake("cargo", "echo cargo 1.75.0")
        self.fake("apt-cache", f"""[ -e {self.path("lists")} ] || exit 0
            case $2 in cargo) echo '  Candidate: 1.75.0' ;; cargo-1.85) echo '  Candidate: 1.85.1' ;; esac""")
        self.fake("apt-get", f"""case $1 in
            update) touch {self.path("lists")} ;;
            install) echo "$*" >{self.path("installed")}; printf '#!/bin/sh\necho cargo 1.85.1\n' >{self.path("cargo-1.85")} ;;
            esac""")
        result = self.set_up(may_install=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("installed")) as file:
            self.assertTrue(file.read().rstrip().endswith(" cargo-1.85"))

    def test_each_way_of_telling_a_version_is_understood(self):
        for tool, told in [("mvn", "\033[1mApache Maven 3.8.7\033[m"), ("javac", "javac 25"), ("node", "v18.20.4"), ("cargo", "cargo 1.100.0 (abc 2027-01-01)"),
                           ("cc", "cc (Ubuntu 13.2.0-23ubuntu4) 13.2.0")]:
            self.assertEqual(self.wanting(tool, told).returncode, 0, told)

    def test_a_tool_that_tells_no_version_is_not_used(self):
        result = self.wanting("npm", None)
        self.assertEqual(result.returncode, 1)
        self.assertIn("npm is of version unknown; needed is 8 or newer", result.stderr)

    def test_a_tool_that_is_replaced_is_asked_again(self):
        self.assertEqual(self.wanting("node", "v18.0.0").returncode, 0)
        self.assertEqual(self.wanting("node", "v16.20.10").returncode, 1)
