"""Controls the processes of a live run: the player, and a compiler that stays loaded between compilations."""
import asyncio
import codecs
import contextlib
import json
import os
import re
import shutil
import socket
import struct
import tempfile
import time
import uuid
from collections.abc import Awaitable, Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from build import inputs, managed, player, projects
from build.console import Failure
from build.jdk import find_jdk

_EXIT_SECONDS = 5
_POLL_SECONDS = 0.01
_HEADER = struct.Struct("<I")
_PROBLEM = re.compile(r"^(?:file://)?(?P<path>.+?\.(?:kt|java)):(?P<line>\d+)(?::(?P<column>\d+))?: (?P<severity>error|warning): (?P<message>.*)$")


@dataclass(frozen=True)
class Compiled:
    """The outcome of a compilation. After errors, `jar` is None."""

    jar: Path | None
    problems: list[dict[str, Any]]
    messages: str
    milliseconds: int


class Compiler:
    """A process that compiles the programs of a plan. It handles one request after the other."""

    def __init__(self, work: Path) -> None:
        self._work = work / "compiler"
        self._folder = work / "requests"
        for folder in (self._work, self._folder):
            folder.mkdir()
        self._process: asyncio.subprocess.Process | None = None
        self._lock = asyncio.Lock()

    async def compile(self, plan: player.Plan) -> Compiled:
        """Compiles the current sources of the plan's programs."""
        async with self._lock:
            start = time.monotonic()
            try:
                programs = inputs.programs(plan.parts["programs"].path)
                arguments = projects.compilation(plan.parts["schema"], programs, self._work, plan.parts.get("runtimeJars"), plan.parts.get("runtimePlugin"))
            except (Failure, OSError) as error:
                return Compiled(None, [], str(error), 0)
            code, messages = await self._request(arguments)
            problems = [_problem(match, programs.path) for line in messages.splitlines() if (match := _PROBLEM.match(line))]
            return Compiled(self._work / "programs.jar" if code == 0 else None, problems, "" if code == 0 else messages,
                            round(1000 * (time.monotonic() - start)))

    async def _request(self, arguments: Sequence[str | Path]) -> tuple[int, str]:
        if self._process is None or self._process.returncode is not None:
            command = projects.compile_server(self._folder)
            self._process = await asyncio.create_subprocess_exec(*command, stdin=asyncio.subprocess.DEVNULL)
        name = uuid.uuid4().hex
        part = self._folder / f"{name}.part"
        part.write_text("".join(f"{argument}\0" for argument in arguments), encoding="utf-8")
        part.rename(self._folder / f"{name}.request")
        response = self._folder / f"{name}.response"
        while not response.exists():
            if self._process.returncode is not None:
                return 1, "the compiler's process ended; save again to restart it"
            await asyncio.sleep(_POLL_SECONDS)
        code, _, messages = response.read_text(encoding="utf-8").partition("\n")
        response.unlink()
        return int(code), messages

    async def close(self) -> None:
        if self._process is not None and self._process.returncode is None:
            self._process.kill()
            await self._process.wait()


def _problem(match: re.Match[str], folder: Path) -> dict[str, Any]:
    # The Kotlin compiler prints paths below the current folder as relative paths.
    path = Path(match["path"]).absolute()
    return {"file": str(path.relative_to(folder)) if path.is_relative_to(folder) else str(path), "line": int(match["line"]),
            "column": int(match["column"] or 1), "severity": match["severity"], "message": match["message"]}


class Player:
    """A process that plays a scenario. Calls `on_message` for each message, with the JSON of its event, and with the whole message if it has a frame."""

    def __init__(self, on_message: Callable[[dict[str, Any], bytes | None], Awaitable[None]]) -> None:
        self._on_message = on_message
        self._process: asyncio.subprocess.Process | None = None
        self._writer: asyncio.StreamWriter | None = None
        self._reading: asyncio.Task[None] | None = None

    async def start(self, scenario: str, plan: player.Plan, jar: Path, dll: Path, folder: Path, options: Sequence[str]) -> None:
        """Starts the process, which writes its outputs to `folder`. Deletes earlier content of the folder first."""
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        own_end, player_end = socket.socketpair()
        with player_end:
            command = player.command("live", scenario, plan, jar, dll, find_jdk(), ["--out", folder, "--channel", str(player_end.fileno()), *options])
            self._process = await asyncio.create_subprocess_exec(
                *command, env=managed.environment("mono-sgen"), stdin=asyncio.subprocess.DEVNULL, pass_fds=[player_end.fileno()])
        reader, self._writer = await asyncio.open_connection(sock=own_end)
        self._reading = asyncio.create_task(self._read(reader, self._process))

    def send(self, command: dict[str, Any]) -> None:
        """Sends a command. This has no effect after the end of the process."""
        if self._writer is not None and not self._writer.is_closing():
            self._writer.write(json.dumps(command).encode() + b"\n")

    async def stop(self) -> None:
        """Ends the process and waits for it."""
        if self._process is None or self._writer is None or self._reading is None:
            return
        self._reading.cancel()
        # The process ends when its channel is closed.
        self._writer.close()
        try:
            await asyncio.wait_for(self._process.wait(), _EXIT_SECONDS)
        except TimeoutError:
            self._process.kill()
            await self._process.wait()
        self._process = None

    async def _read(self, reader: asyncio.StreamReader, process: asyncio.subprocess.Process) -> None:
        stopped = False
        with contextlib.suppress(asyncio.IncompleteReadError, ConnectionError):
            while True:
                (length,) = _HEADER.unpack(await reader.readexactly(_HEADER.size))
                message = await reader.readexactly(length)
                end = message.index(0)
                event = json.loads(message[:end])
                stopped |= event["event"] == "stopped"
                await self._on_message(event, message if event["event"] == "frame" else None)
        code = await process.wait()
        if not stopped:
            await self._on_message({"event": "stopped", "message": f"the player ended with exit code {code}; the reason is in the terminal"}, None)


@dataclass(frozen=True)
class Source:
    """A source file of the programs. The text has line feeds and no byte-order mark. `problem` is the reason why the file cannot be edited, or empty."""

    path: Path
    text: str
    problem: str
    mark: bytes
    newline: str

    def write(self, text: str) -> None:
        """Replaces the content atomically. Keeps the byte-order mark, line endings, permissions and a link to the file."""
        target = self.path.resolve()
        descriptor, part = tempfile.mkstemp(".part", f".{target.name}.", target.parent)
        try:
            with os.fdopen(descriptor, "wb") as output:
                output.write(self.mark + text.replace("\n", self.newline).encode())
            os.chmod(part, target.stat().st_mode)
            os.replace(part, target)
        except BaseException:
            os.unlink(part)
            raise


def sources(plan: player.Plan, folder: Path) -> dict[str, Source]:
    """Returns the program sources by relative path. A jar has none. A link must stay inside the programs folder or `folder`."""
    programs = plan.parts["programs"].path
    if programs.is_file():
        return {}
    roots = [programs.resolve(), folder.resolve()]
    return {name: _source(file, roots) for name, file in inputs.programs(programs).files.items()}


def _source(path: Path, roots: list[Path]) -> Source:
    content = path.read_bytes()
    mark = codecs.BOM_UTF8 if content.startswith(codecs.BOM_UTF8) else b""
    target = path.resolve()
    problem = "" if any(map(target.is_relative_to, roots)) else f"the file is a link to '{target}', which is not in the project's folder"
    try:
        text = content[len(mark):].decode()
    except UnicodeDecodeError as error:
        text = content.decode(errors="replace")
        problem = f"the file is not UTF-8 (byte {error.start + len(mark)}): convert it in another editor"
    ends = text.count("\r\n")
    newline = "\r\n" if 2 * ends > text.count("\n") else "\n"
    return Source(path, re.sub("\r\n?", "\n", text), problem, mark, newline)


class Changes:
    """Detects changes of sources that other programs made. Sources that were missing count as changed, because their compilation may have failed."""

    def __init__(self, read: Callable[[], dict[str, Source]]) -> None:
        self._read = read
        self._were_missing = False

    def since(self, known: dict[str, Source]) -> dict[str, Source] | None:
        """Returns the changed sources, or None if they equal the known ones or cannot be read, for example while an editor replaces a file."""
        try:
            current = self._read()
        except (OSError, Failure):
            self._were_missing = True
            return None
        is_changed, self._were_missing = self._were_missing or current != known, False
        return current if is_changed else None


@contextlib.contextmanager
def new_file(path: Path) -> Iterator[BinaryIO]:
    """Opens a new file, and removes it after an error. Raises `FileExistsError` if a file or link of that name exists."""
    with path.open("xb") as output:
        try:
            yield output
            output.flush()
        except BaseException:
            path.unlink()
            raise


def replace(jar: Path, new: Path) -> None:
    """Replaces a jar atomically."""
    part = jar.with_suffix(".part")
    shutil.copyfile(new, part)
    os.replace(part, jar)
