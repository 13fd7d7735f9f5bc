"""Runs the server of `./collektive live`: `server.py OPTIONS`, where OPTIONS are the command's options as JSON.

The server listens on 127.0.0.1 only. The address of the page contains a secret token. The server refuses requests with another token, Host or Origin.
"""
import asyncio
import contextlib
import errno
import http
import json
import os
import secrets
import shlex
import signal
import sys
import tempfile
import time
from collections import deque
from dataclasses import replace
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from build import player, processes, projects
from build.console import Failure, print_progress
from build.places import BUILD
from live import examples, session
from live.record import Record

HOST = "127.0.0.1"
# The server disconnects a page that sends more commands per second.
MAX_COMMANDS = 200
# The server disconnects a page that has more unsent events. Frames do not count.
MAX_WAITING = 500
WATCH_SECONDS = 0.25
PAGES = {"": "live.html", "view": "live-view.html"}
# Commands that the player executes.
PLAYER_COMMANDS = {"run", "step", "speed", "add", "remove", "select", "parameter"}


class Page:
    """A connected page. It receives all events in order, but a new frame replaces an unsent one."""

    def __init__(self, connection: ServerConnection) -> None:
        self.connection = connection
        self._events: deque[str] = deque()
        self._frame: bytes | None = None
        self._ready = asyncio.Event()

    def event(self, event: dict[str, Any]) -> None:
        self._events.append(json.dumps(event))
        self._ready.set()

    def frame(self, message: bytes) -> None:
        self._frame = message
        self._ready.set()

    async def send(self) -> None:
        """Sends events and frames until the page is closed or is too slow for the events."""
        while True:
            await self._ready.wait()
            if len(self._events) > MAX_WAITING:
                await self.connection.close(1008, "the page is too slow")
                return
            if self._events:
                await self.connection.send(self._events.popleft())
            elif self._frame is not None:
                frame, self._frame = self._frame, None
                await self.connection.send(frame)
            else:
                self._ready.clear()


class Live:
    """A running scenario, its sources, and the pages that show it. The page that has been connected for the longest time controls the scenario."""

    def __init__(self, options: dict[str, Any], work: Path) -> None:
        self.scenario: str = options["scenario"]
        self.trust: bool = options["trust_jvm"]
        self.seed: str | None = options["seed"]
        self.values: dict[str, str] = dict(value.partition("=")[::2] for value in options["values"])
        # The values that the page has set since the start, by program and parameter.
        self.parameters: dict[tuple[str, str], str] = {}
        self.examples = examples.catalogue()
        self.pages: list[Page] = []
        self.work = work
        self.jar = work / "programs.jar"
        self.plan: player.Plan
        self.header: dict[str, Any] | None = None
        self.last_frame: bytes | None = None
        self.stopped: dict[str, Any] | None = None
        self.compiled: dict[str, Any] | None = None
        self.player = session.Player(self.on_message)
        self.compiler = session.Compiler(work)
        self.record = Record(work / "out/run.clkrec")
        self._sources: dict[str, session.Source] = {}
        self._changing = asyncio.Lock()

    def player_options(self, changes: dict[str, Any] | None = None) -> list[str]:
        """Returns the player's command-line options for the scenario, with these changes of its keys."""
        seed = [] if self.seed is None else ["--seed", self.seed]
        values = {**self.values, **{key: _text(value) for key, value in (changes or {}).items()}}
        return [*seed, *(word for key, value in values.items() for word in ("--set", f"{key}={value}")), *(["--trust-jvm"] if self.trust else [])]

    async def start(self) -> None:
        """Reads the scenario, compiles changed code, and starts the player."""
        plan = await asyncio.to_thread(player.plan, self.scenario, self.player_options())
        # The plan and its sources change together, because the file watcher compares them.
        sources = self.read_sources(plan)
        # Otherwise, the page could show newer programs than those that run.
        await asyncio.to_thread(plan.require_unchanged)
        self.plan, self._sources = plan, sources
        self.header = self.last_frame = self.stopped = self.compiled = None
        self.parameters = {}
        jar, dll = await asyncio.gather(asyncio.to_thread(plan.programs_jar), asyncio.to_thread(plan.scripts_dll))
        # The previous record may have filled the disk.
        self.record.begin()
        session.replace(self.jar, jar)
        projects.record_own_program(self.jar)
        await self.player.start(self.scenario, self.plan, self.jar, dll, self.work / "out", self.player_options())

    async def restart(self, scenario: str, seed: str | None, values: dict[str, str], trust: bool) -> None:
        """Starts a scenario in place of the running one. If it is invalid, keeps the previous scenario and values."""
        before = self.scenario, self.seed, self.values, self.trust
        plan = self.plan
        self.scenario, self.seed, self.values, self.trust = scenario, seed, values, trust
        stopped = None
        try:
            await self.player.stop()
            await self.start()
        except (Failure, OSError, ValueError) as failure:
            # A value with a null character causes a ValueError. The player has already printed the error of an invalid scenario, and the compilers have
            # printed their errors.
            reason = str(failure) or f"the {'scenario is invalid' if self.plan is plan else 'sources do not compile'}; the reason is in the terminal"
            stopped = {"event": "stopped", "message": reason}
        if self.plan is plan:
            self.scenario, self.seed, self.values, self.trust = before
        else:
            self.broadcast({"event": "started"})
            for page in self.pages:
                self.send_welcome(page)
        if stopped is not None:
            self.stopped = stopped
            self.broadcast(stopped)
            if self.plan is not plan and self.is_editable:
                await self.compile()

    async def open_example(self, name: str) -> None:
        """Runs a lesson or sample in place of the running scenario."""
        scenario = examples.find(name) if name in (*examples.LESSONS, *examples.SAMPLES) else None
        if scenario is None:
            raise ValueError(f"unknown example '{name}'")
        try:
            copy = examples.copy(scenario)
        except (Failure, OSError) as error:
            self.broadcast({"event": "warning", "message": f"cannot copy the example: {error}"})
            return
        await self.restart(str(copy), None, {}, False)

    def read_sources(self, plan: player.Plan) -> dict[str, session.Source]:
        return session.sources(plan, Path(self.scenario).parent)

    @property
    def files(self) -> dict[str, dict[str, str]]:
        """Returns the sources in the form that the page shows."""
        return {name: {"text": source.text, "problem": source.problem} for name, source in self._sources.items()}

    def identity(self) -> dict[str, str]:
        """Returns the seed, and the command that repeats the run from its start."""
        words = ["./collektive", "live", os.path.relpath(self.scenario), *self.player_options()]
        return {"seed": self.seed or str(self.plan["seed"]), "command": shlex.join(words)}

    @property
    def is_editable(self) -> bool:
        """Whether the programs are sources, not a jar."""
        return self.plan.parts["programs"].path.is_dir()

    def broadcast(self, event: dict[str, Any]) -> None:
        for page in self.pages:
            page.event(event)

    async def on_message(self, event: dict[str, Any], frame: bytes | None) -> None:
        if frame is not None:
            self.last_frame = frame
            for page in self.pages:
                page.frame(frame)
            return
        if event["event"] == "header":
            self.header = event
        if event["event"] == "stopped":
            self.stopped = event
        self.broadcast(event)

    async def connect(self, connection: ServerConnection) -> None:
        """Serves a page until it is closed."""
        page = Page(connection)
        self.pages.append(page)
        self.send_welcome(page)
        for event in (self.compiled, self.stopped):
            if event is not None:
                page.event(event)
        if self.last_frame is not None:
            page.frame(self.last_frame)
        sending = asyncio.create_task(page.send())
        try:
            await self.receive(page)
        except ConnectionClosed:
            pass  # the page was closed, which can happen at any time
        finally:
            sending.cancel()
            with contextlib.suppress(asyncio.CancelledError, ConnectionClosed):
                await sending
            was_controller = self.pages[0] is page
            self.pages.remove(page)
            if was_controller and self.pages:
                self.send_welcome(self.pages[0])

    def send_welcome(self, page: Page) -> None:
        page.event({"event": "welcome", "controls": self.pages[0] is page, "title": Path(self.scenario).parent.name, "scenario": self.scenario,
                    "files": self.files, "editable": self.is_editable, "examples": self.examples, **self.identity()})
        if self.header is not None:
            # The player sends no header after a change of a parameter, because pages would build their controls again.
            for (program, parameter), value in self.parameters.items():
                self.header["parameters"].setdefault(program, {})[parameter] = value
            page.event(self.header)

    async def receive(self, page: Page) -> None:
        start, count = time.monotonic(), 0
        async for text in page.connection:
            now = time.monotonic()
            if now - start > 1:
                start, count = now, 0
            count += 1
            if count > MAX_COMMANDS:
                await page.connection.close(1008, "too many commands")
                return
            try:
                command = json.loads(text, parse_constant=_refuse)
                await self.execute(page, command)
            except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
                page.event({"event": "warning", "message": f"a command from the page is invalid: {error!r}"})
            except OSError as error:
                page.event({"event": "warning", "message": str(error)})

    async def execute(self, page: Page, command: dict[str, Any]) -> None:
        if self.pages[0] is not page:
            if "select" not in command:
                page.event({"event": "warning", "message": "Another page controls the simulation."})
        elif "save" in command:
            await self.save(page, command["save"], command["text"], command["base"])
        elif "restart" in command:
            async with self._changing:
                changes = {key: _text(value) for key, value in command["restart"].items()}
                await self.restart(self.scenario, str(command["seed"]), {**self.values, **changes}, self.trust)
        elif "open" in command:
            async with self._changing:
                await self.open_example(command["open"])
        elif "scenario" in command:
            page.event({"event": "warning", "message": await self.save_scenario(command["scenario"], command["set"])})
        elif "record" in command:
            page.event({"event": "warning", "message": await self.save_record(command["record"])})
        elif PLAYER_COMMANDS & command.keys():
            if "parameter" in command and not self.accept(page, command["program"], command["parameter"], command["value"]):
                return
            self.player.send(command)
        else:
            raise KeyError(next(iter(command), ""))

    def accept(self, page: Page, program: str, parameter: str, value: str) -> bool:
        """Stores the value of a parameter. If it is invalid, returns False and sends a warning to the page."""
        known = projects.parameters(self.jar).get(program, {})
        try:
            # The jar may lack the parameter after an edit that the player has rejected.
            player.check_parameters({program: {parameter: value}}, {program: known} if parameter in known else {})
        except Failure as failure:
            page.event({"event": "warning", "message": str(failure)})
            return False
        self.parameters[program, parameter] = value
        return True

    async def save(self, page: Page, name: str, text: str, base: str) -> None:
        """Writes a source file of the programs, and reloads the programs. Refuses if the file no longer has the text `base`, which the page changed."""
        try:
            source = self.read_sources(self.plan).get(name)
        except (OSError, Failure) as error:
            page.event({"event": "warning", "message": f"cannot read the programs: {error}"})
            return
        problem = f"'{name}' is not a file in the programs folder" if source is None else source.problem
        if source is None or problem:
            page.event({"event": "warning", "message": problem})
            return
        if source.text not in (base, text):
            page.event({"event": "conflict", "file": name, "text": source.text})
            page.event({"event": "warning", "message": f"'{name}' was changed in another editor; save again to replace that change"})
            return
        try:
            source.write(text)
        except OSError as error:
            page.event({"event": "warning", "message": f"cannot write '{source.path}': {error.strerror}"})
            return
        self._sources[name] = replace(source, text=text)
        self.broadcast({"event": "files", "files": self.files})
        await self.reload()

    async def reload(self) -> None:
        """Compiles the programs, and loads them into the running simulation if that succeeds."""
        async with self._changing:
            await self.compile()

    async def compile(self) -> None:
        compiled = await self.compiler.compile(self.plan)
        self.compiled = {"event": "compiled", "problems": compiled.problems, "messages": compiled.messages, "milliseconds": compiled.milliseconds}
        self.broadcast(self.compiled)
        if compiled.jar is None:
            return
        session.replace(self.jar, compiled.jar)
        projects.record_own_program(self.jar)
        self.player.send({"reload": True})

    async def watch(self) -> None:
        """Reloads programs that another editor changed."""
        changes = session.Changes(lambda: self.read_sources(self.plan))
        while True:
            await asyncio.sleep(WATCH_SECONDS)
            with contextlib.suppress(OSError):
                if self.record.limit():
                    self.broadcast({"event": "warning", "message": self.record.deletion})
            current = changes.since(self._sources)
            if current is not None:
                self._sources = current
                self.broadcast({"event": "files", "files": self.files})
                await self.reload()

    def beside_scenario(self, name: str, suffix: str) -> Path | None:
        """Returns the path of a new file beside the scenario, or None if the name is not a plain file name with the given suffix."""
        return Path(self.scenario).with_name(name) if Path(name).name == name and name.endswith(suffix) and name != suffix else None

    async def save_record(self, name: str) -> str:
        """Copies the record of the run so far, and returns a message about it."""
        file = self.beside_scenario(name, ".clkrec")
        if file is None:
            return "enter a file name that ends in .clkrec; the file is saved beside the scenario"
        try:
            # A restart would replace the record.
            async with self._changing:
                await asyncio.to_thread(self.record.save, file)
        except FileExistsError:
            return f"'{file.name}' already exists: enter another name"
        except OSError as error:
            return f"cannot write '{file}': {error.strerror}"
        except Failure as failure:
            return str(failure)
        return f"saved; replay it with ./collektive replay {shlex.quote(os.path.relpath(file))}"

    async def file_values(self) -> Any:
        """Returns the values of the scenario file with the command's options."""
        return (await asyncio.to_thread(player.plan, self.scenario, self.player_options()))["file"]

    async def save_scenario(self, name: str, changes: dict[str, Any]) -> str:
        """Writes a scenario with the current values, and returns a message about it."""
        file = self.beside_scenario(name, ".json")
        if file is None:
            return "enter a file name that ends in .json; the file is saved beside the scenario"
        try:
            plan = await asyncio.to_thread(player.plan, self.scenario, self.player_options(changes))
            # Comments may change.
            if plan.content != self.plan.content and await self.file_values() != self.plan["file"]:
                raise Failure(f"'{Path(self.scenario).name}' changed since the start of the run; press Restart first")
            values = plan["file"]
            if "scenario" in values:
                raise Failure(f"'{Path(self.scenario).name}' is the manifest of a run, which cannot be changed; open its scenario")
            if self.seed is not None:
                values["seed"] = int(self.seed)
            self._keep_texts(values.get("fields", {}), changes)
            known = projects.parameters(self.jar)
            # An edit may have removed the parameter. The jar may also contain an edit that the player has rejected.
            missing = [key for key in self.parameters if known and key[1] not in known.get(key[0], {})]
            for (program, parameter), value in self.parameters.items():
                if (program, parameter) not in missing:
                    values.setdefault("parameters", {}).setdefault(program, {})[parameter] = value
            player.check_parameters(values.get("parameters", {}), known)
            with session.new_file(file) as output:
                output.write((json.dumps(values, indent=2) + "\n").encode())
        except Failure as failure:
            return f"not saved: {str(failure) or 'the scenario is invalid; the reason is in the terminal'}"
        except FileExistsError:
            return f"'{file.name}' already exists: enter another name"
        except OSError as error:
            return f"cannot write '{file}': {error.strerror}"
        omitted = f" without {', '.join(map('.'.join, missing))}, which the edited programs do not declare" if missing else ""
        return f"saved as {os.path.relpath(file)}{omitted}"

    def _keep_texts(self, fields: dict[str, Any], changes: dict[str, Any]) -> None:
        """Writes values of text fields as texts. Only the running scene knows the types of its fields, so the player has read "5" as a number."""
        shown = self.header["sceneFields"] if self.header else {}
        for key, value in {**self.values, **changes}.items():
            name = key.removeprefix("fields.")
            # Numbers that are not finite are also shown as texts.
            if name in fields and isinstance(shown.get(name), str) and shown[name] not in ("NaN", "Infinity", "-Infinity"):
                fields[name] = _text(value)

    async def close(self) -> None:
        await self.player.stop()
        await self.compiler.close()


def _text(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value)


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is not a JSON number")


class Gate:
    """Serves the page's files, and refuses requests from other pages."""

    def __init__(self, token: str) -> None:
        self.token = token
        self.port = 0

    @property
    def hosts(self) -> list[str]:
        return [f"{HOST}:{self.port}", f"localhost:{self.port}"]

    def __call__(self, _: ServerConnection, request: Request) -> Response | None:
        if request.headers.get_all("Host") not in [[host] for host in self.hosts]:
            return _answer(http.HTTPStatus.FORBIDDEN, b"unknown host\n")
        token, _, name = request.path.removeprefix("/").partition("/")
        if not secrets.compare_digest(token.encode(), self.token.encode()):
            return _answer(http.HTTPStatus.FORBIDDEN, b"the address has no valid token: copy it from the terminal\n")
        if name == "socket":
            origins = request.headers.get_all("Origin")
            return None if origins in [[f"http://{host}"] for host in self.hosts] else _answer(http.HTTPStatus.FORBIDDEN, b"unknown origin\n")
        if name not in PAGES:
            return _answer(http.HTTPStatus.NOT_FOUND, b"not found\n")
        return _answer(http.HTTPStatus.OK, (BUILD / PAGES[name]).read_bytes(), "text/html")


def _answer(status: http.HTTPStatus, body: bytes, kind: str = "text/plain") -> Response:
    headers = {"Content-Type": f"{kind}; charset=utf-8", "Content-Length": str(len(body)), "Cache-Control": "no-store", "Referrer-Policy": "no-referrer",
               "X-Content-Type-Options": "nosniff", "X-Frame-Options": "SAMEORIGIN", "Cross-Origin-Resource-Policy": "same-origin",
               "Connection": "close"}
    return Response(status.value, status.phrase, Headers(headers), body)


async def open_server(live: Live, gate: Gate, port: int) -> Server:
    try:
        server = await serve(live.connect, HOST, port, process_request=gate, compression=None, server_header=None)
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            raise Failure(f"port {port} is in use: choose another one, or omit --port") from error
        raise Failure(f"cannot listen on port {port}: {error.strerror}") from error
    gate.port = next(iter(server.sockets)).getsockname()[1]
    return server


async def main(options: dict[str, Any]) -> int:
    ended = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, ended.set)
    gate = Gate(secrets.token_urlsafe(24))
    with tempfile.TemporaryDirectory(prefix="collektive-live-") as folder:
        live = Live(options, Path(folder))
        server = await open_server(live, gate, options["port"])
        try:
            await live.start()
            address = f"http://{HOST}:{gate.port}/{gate.token}/"
            print_progress("running; press Ctrl-C to stop")
            print(address, flush=True)
            if not options["no_browser"] and (sys.platform == "darwin" or os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
                processes.start_detached([sys.executable, "-I", "-m", "webbrowser", address])
            watching = asyncio.create_task(live.watch())
            # Compile once in advance, because the first compilation takes seconds and later ones are fast.
            warming = asyncio.create_task(live.compiler.compile(live.plan)) if live.is_editable else None
            waiting = asyncio.create_task(ended.wait())
            # The file watcher ends only with an error, which must end the server.
            await asyncio.wait([watching, waiting], return_when=asyncio.FIRST_COMPLETED)
            waiting.cancel()
            if watching.done():
                watching.result()
            for task in (watching, warming):
                if task is not None:
                    task.cancel()
        finally:
            server.close()
            await live.close()
    return 0


if __name__ == "__main__":
    try:
        sys.exit(asyncio.run(main(json.loads(sys.argv[1]))))
    except (Failure, OSError) as failure:
        if str(failure):
            print(f"collektive: {failure}", file=sys.stderr)
        sys.exit(getattr(failure, "code", None) or 1)
