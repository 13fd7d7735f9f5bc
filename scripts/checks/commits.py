"""Checks the subjects of the commits since BASE, and exits with code 1 if one must be changed: `commits.py BASE`."""
import re
import subprocess
import sys

MAX_LENGTH = 72
# Matches words such as "Reports", "Reported" and "Reporting", but not imperatives such as "Address", "Focus", "Bring" and "Embed".
NOT_IMPERATIVE = re.compile(r"(?!(Bring|String|Ping|Embed|Feed|Need|Seed|Shed|Speed|Bias|Focus|Alias|Canvas)\b)[A-Z]\w*(ing|[^s]s|ed)\b")


def problem(subject: str) -> str | None:
    """Returns the error in the subject of a commit, or None if the subject is valid."""
    if subject.startswith(("Merge ", "Revert ")):
        return None
    if len(subject) > MAX_LENGTH:
        return f"has {len(subject)} characters; shorten it to at most {MAX_LENGTH}"
    if not re.match(r"[A-Z]", subject) or subject.endswith("."):
        return "must begin with a capital letter and end without a full stop"
    if NOT_IMPERATIVE.match(subject) or " " not in subject:
        return "must be imperative, as in 'Report repeated sensor errors once'"
    return None


def main(base: str) -> int:
    log = subprocess.run(["git", "log", "--format=%h %s", f"{base}..HEAD"], capture_output=True, text=True, check=True).stdout
    found = [f"{commit}: the subject '{subject}' {reason}" for commit, subject in (line.split(" ", 1) for line in log.splitlines())
             if (reason := problem(subject))]
    print(*found, sep="\n", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
