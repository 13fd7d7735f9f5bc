"""Tests the standard scene and metrics in SQL. Errors must be reported before the first run, and results must be reproducible."""
import base64
import copy
import csv
import gzip
import json
import math
import re
import shutil
import socket
import struct
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from conftest import COLLEKTIVE, ROOT

from collektive_experiments.bundle import programs_jar
from collektive_experiments.worker import Outcome, Worker, java_home

PROGRAM = """package first

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import org.collektive.api.Metric
import org.collektive.api.NetworkSnapshot
import org.collektive.api.Program
import standard.ActuatorData
import standard.SensorData
import kotlin.math.abs
import kotlin.math.hypot

@Program("hops")
fun Aggregate<Int>.hops(sensors: SensorData): ActuatorData {
    val hops = hopDistanceTo(sensors.source())
    return ActuatorData(value = hops.toDouble(), flag = hops < Int.MAX_VALUE, category = hops)
}

@Metric("farthest")
fun farthest(network: NetworkSnapshot<SensorData, ActuatorData>): Double = network.nodes.maxOf { it.answer?.value ?: -1.0 }

@Metric("sources")
fun sources(network: NetworkSnapshot<SensorData, ActuatorData>): Double = network.nodes.count { it.sensors?.source() == true }.toDouble()

@Metric("step")
fun step(network: NetworkSnapshot<SensorData, ActuatorData>): Double =
    network.nodes.maxOf { node -> node.links.maxOf { (node.answer?.value ?: 0.0) - (network[it.from]?.answer?.value ?: 0.0) } }

@Metric("error")
fun error(network: NetworkSnapshot<SensorData, ActuatorData>): Double {
    val places = network.nodes.associate { node -> node.id to node.sensors?.position() }
    return network.nodes.maxOf { node ->
        node.links.maxOfOrNull { link ->
            val a = places.getValue(node.id)
            val b = places.getValue(link.from)
            if (a == null || b == null) Double.NaN else abs(link.length - hypot((a.x() - b.x()).toDouble(), (a.z() - b.z()).toDouble()))
        } ?: 0.0
    }
}

@Metric("late")
fun late(network: NetworkSnapshot<SensorData, ActuatorData>): Double {
    check(network.time < 0.45) { "too late" }
    return 1.0
}
"""
DATA = {
    "stations.csv": '\ufeffname,id,x,z\n"A, ""old"" north" ,7,1,2\n\nB,3,-1.5,4e0\n',
    "walk.csv": "time,id,x,z\n0,0,0,0\n1,1,0,6\n2,0,4,0\n3,0,4,8\n",
    "walk%20.gpx": """<?xml version="1.0"?>
<gpx version="1.1" creator="test" xmlns="http://www.topografix.com/GPX/1/1">
  <trk><trkseg><trkpt lat="44.0" lon="12.000"><time>2026-01-31T12:00:00Z</time></trkpt>
    <trkpt lat="44.0" lon="12.001"><time>2026-01-31T12:00:04Z</time></trkpt></trkseg></trk>
  <trk><trkseg><trkpt lat="44.001" lon="12.0"><time>2026-01-31T12:00:02Z</time></trkpt></trkseg></trk>
</gpx>""",
    "fast.gpx": """<gpx><trk><trkpt lat="0" lon="0"><time>2026-01-31T12:00:00Z</time></trkpt><trkpt lat="0" lon="1"><time>2026-01-31T12:00:00.1Z</time></trkpt>
<trkpt lat="0" lon="-1"><time>2026-01-31T12:00:00.100003Z</time></trkpt></trk></gpx>""",
    "cities.geojson": json.dumps({"type": "FeatureCollection", "crs": {"properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}, "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [12, 44, 30]}},
        {"type": "Feature", "properties": {}, "geometry": {"type": "MultiPoint", "coordinates": [[12.002, 44], [12.001, 44.001]]}}]}),
    "islands.csv": "lon,lat\n179.9999,0\n-179.9999,0\n",
    "world.csv": "lon,lat\n-100,0\n-10,0\n90,0\n",
    "ring.csv": "x,z\n" + "".join(f"{3 * math.cos(angle / 10 * math.pi)},{3 * math.sin(angle / 10 * math.pi)}\n" for angle in range(20)),
    "values.csv": "time,id,value\n0,0,5\n1,0,6\n0.5,1,7\n",
    "bad/cells.csv": "x,z\n1,2\n3\n",
    "bad/number.csv": "x,z\n1,2\n\n3,abc\n",
    "bad/columns.csv": "x,y\n1,2\n",
    "bad/empty.csv": "x,z\n",
    "bad/quote.csv": 'name,x,z\n"A,1,2\n',
    "bad/inside.csv": 'x,z\n3"5",2\n',
    "bad/after.csv": 'x,z\n"3"5,2\n',
    "bad/null.csv": "x,z\n1,2\n3,4\0\0\0\n",
    "bad/ids.csv": "id,x,z\n1,0,0\n1,5,5\n",
    "bad/id.csv": "id,x,z\n-1,0,0\n",
    "bad/back.csv": "time,id,x,z\n1,0,0,0\n1,0,1,1\n",
    "bad/no-ids.csv": "time,x,z\n1,0,0\n",
    "bad/degrees.csv": "lon,lat\n12,144\n",
    "bad/twice.csv": "x,z,x\n1,2,3\n",
    "bad/case.csv": "ID,x,z\n7,1,2\n",
    "bad/large.csv": "x,z\n1,1e39\n",
    "bad/xml.gpx": "<gpx>\n<trk>\n</gpx>",
    "bad/time.gpx": '<gpx>\n<trk>\n<trkpt lat="1" lon="1"/></trk></gpx>',
    "bad/noon.gpx": '<gpx>\n<trk>\n<trkpt lat="1" lon="1"><time>12:00:00Z</time></trkpt></trk></gpx>',
    "bad/line.geojson": '{"type": "Feature",\n"geometry":\n{"type": "LineString", "coordinates": []}}',
    "bad/place.geojson": '{"type": "FeatureCollection", "features": [\n{"type": "Feature", "geometry": null}]}',
    "bad/point.geojson": '{"type": "Point",\n"coordinates": ["a", 1]}',
    "bad/json.geojson": '{"type": "Point"\n',
    "bad/values.csv": "time,id,value\n1,0,5\n1,0,6\n",
    "bad/type.geojson": '{"type": []}',
    "bad/metres.geojson": '{"type": "Point", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::2154"}}, "coordinates": [9, 7]}',
    "bad/none.geojson": '{"type": "FeatureCollection", "features": []}',
    "bad/none.gpx": '<gpx><wpt lat="1" lon="1"/></gpx>',
    "bad/all.csv": "value,id\n5,-1\n",
    "bad/value.csv": "id\n0\n",
    "thirds.csv": "time,value\n1,5\n",
    "far.csv": "x,z\n100000,100000\n100000,100050\n",
    "file.txt": "x,z\n1,2\n",
}
SCENARIO: dict[str, Any] = {
    "version": 1, "scene": "standard", "programs": "programs", "data": "data", "program": "hops",
    "fields": {
        "deployment": {"nodes": 36, "spacing": 3, "disorder": 0.5},
        "neighbourhood": {"radius": 5},
        "sets": [{"name": "source", "near": [0, 0], "count": 2}],
        "obstacles": [{"box": [7, 7], "size": [1, 1]}],
        "movement": {"kind": "RandomWaypoint", "speed": 2},
        "churn": {"failures": 0.02, "arrivals": 1},
    },
    "metrics": {"reached": "avg(flag)", "mean": "avg(value) filter (where flag)", "sources": "total(source)", "degree_mean": "avg(degree)"},
    "converged": {"reached": {"from": 0.9}}, "seconds": 5, "deltaTime": 0.1,
}
# The path of a key, an invalid value, and a part of the message. SqlMetricsTests tests more invalid metrics.
REFUSED: list[tuple[str, Any, str]] = [
    ("metrics.bad", "avg(knwon)", "no such column: knwon, at character 5 of 'avg(knwon)'; columns: id, time, degree, x, y, z, message_values, "),
    ("metrics.bad", "avg(flag", "'avg(flag' ends too early"),
    ("metrics.bad", "flag", "'metrics.bad' is not an aggregate"),
    ("metrics.bad", "random() + avg(flag)", "not authorized to use function: random, at character 1"),
    ("metrics.bad", 3, "'metrics.bad' is 3; it must be of type string"),
    ("metrics.bad", {"function": 3}, "'metrics.bad.function' is 3; it must be of type string"),
    ("metrics.bad", {}, "'metrics.bad.function' is missing"),
    ("metrics.bad", {"function": "step", "unit": "m"}, "unknown key 'metrics.bad.unit'; known here: function"),
    ("metrics.links", "count(*)", "'metrics.links': metrics.csv already has a column of that name: rename the metric"),
    ("converged.speed", {"to": 1}, "unknown metric; the metrics are: reached, mean, sources, degree_mean"),
    ("fields.deployment.kind", "Ring", "it must be of type string (one of Grid, Disc, Uniform, Poisson, File)"),
    ("fields.deployment.nodez", 5, "unknown key 'deployment.nodez'; known here: kind, nodes"),
    ("fields.deployment.nodes", 0, "'deployment.nodes' is 0; it must be from 1 to 1000000"),
    ("fields.deployment.nodes", 2.5, "'deployment.nodes' is 2.5; it must be of type whole number"),
    ("fields.deployment.spacing", -3, "'deployment.spacing' is -3; it must be a number greater than 0"),
    ("fields.deployment.disorder", -1, "'deployment.disorder' is -1; it must be at least 0"),
    ("fields.deployment.radius", 0, "'deployment.radius' is 0; it must be a number greater than 0"),
    ("fields.deployment.nodes", 10**9, "'deployment.nodes' is 1000000000; it must be from 1 to 1000000"),
    ("fields.deployment.size", [30], "'deployment.size' must be two numbers greater than 0"),
    ("fields.deployment.columns", -1, "'deployment.columns' is -1"),
    ("fields.deployment.polygon", [[0, 0], [1, 1]], "'deployment.polygon' has 2 corners; it needs at least 3"),
    ("fields.deployment.polygon", [[0, 0], [1, 1], [2]], "'deployment.polygon' must be a list of [x, z]"),
    ("fields.deployment.polygon", [0, 0], "'deployment.polygon[0]' must be a list"),
    ("fields.deployment", "grid", "'deployment' is \"grid\"; it must be of type object"),
    ("fields.neighbourhood.radius", -1, "'neighbourhood.radius' is -1"),
    ("fields.neighbourhood.count", 0, "'neighbourhood.count' is 0; it must be at least 1"),
    ("fields.neighbourhood.lengthTolerance", -0.1, "'neighbourhood.lengthTolerance' is -0.1; it must be at least 0"),
    ("fields.sets", [{"name": "a"}], "'sets[0]' needs 'ids' or 'near'"),
    ("fields.sets", [{"near": [0, 0]}], "'sets[0].name' is missing"),
    ("fields.sets", [{"name": "a", "ids": [1]}, {"name": "a", "ids": [2]}], "'sets[1].name' is 'a', which is also the name of another set"),
    ("fields.sets", [{"name": "a", "ids": [36]}], "'sets[0].ids' contains node 36, but the ids of the deployment are 0 to 35"),
    ("fields.sets", [{"name": "a", "near": [0, 0], "count": 40}], "'sets[0].count' is 40; it must be from 1 to the number of nodes, 36"),
    ("fields.obstacles", [{"size": [1, 1]}], "'obstacles[0]' needs either 'box' or 'polygon'"),
    ("fields.obstacles", [{"polygon": [[0, 0], [1, 0]]}], "'obstacles[0].polygon' has 2 corners; it needs at least 3"),
    ("fields.movement.speed", 0, "'movement.speed' is 0; it must be a number greater than 0"),
    ("fields.movement.exponent", 1, "'movement.exponent' is 1; it must be greater than 1"),
    ("fields.churn.failures", -0.1, "'churn.failures' is -0.1"),
    ("fields.crowd", {}, "has no public field 'crowd'; it has: deployment, neighbourhood, sets, obstacles, movement, churn, reading"),
    ("fields.deployment", {"kind": "File"}, "'deployment.file': the name of a file is missing"),
    ("fields.deployment", {"kind": "File", "file": "../scenario.json"}, "'deployment.file': '../scenario.json' is not a file in the folder 'data', "),
    ("fields.deployment", {"kind": "File", "file": "missing.csv"}, "'deployment.file': 'missing.csv' is not a file in the folder 'data', "),
    ("fields.deployment", {"kind": "File", "file": "file.txt"}, "file.txt: the name must end in .csv, .geojson, .json or .gpx"),
    *[("fields.deployment", {"kind": "File", "file": f"bad/{name}"}, f"'deployment.file': bad/{name}{message}") for name, message in (
        ("cells.csv", ":3: the number of cells is 1, but the first line has 2"), ("number.csv", ":4: 'z' is 'abc'; it must be a number"),
        ("columns.csv", ":1: the columns 'x' and 'z', or 'lon' and 'lat', are missing"), ("empty.csv", ":1: the file has no rows"),
        ("quote.csv", ":2: a quote is not closed"), ("inside.csv", ":2: a quote is inside a cell"),
        ("after.csv", ":2: a cell continues after its closing quote"), ("null.csv", ":3: the line contains a null character"),
        ("ids.csv", ":3: node 1 is also in line 2"), ("id.csv", ":2: 'id' is -1"),
        ("back.csv", ":3: the time must be after that of the previous point of node 0"), ("no-ids.csv", ":1: the column 'time' needs the column 'id'"),
        ("twice.csv", ":1: the column 'x' occurs twice"),
        ("case.csv", ":1: the column 'ID' differs from 'id' only in its case"), ("large.csv", ":2: the position is too large"),
        ("degrees.csv", ":2: longitude 12 and latitude 144 are out of range"), ("xml.gpx", ":3: not valid XML: "),
        ("line.geojson", ":3: 'type' is 'LineString': only points are supported"),
        ("place.geojson", ":2: the feature has no geometry"), ("point.geojson", ":1: 'coordinates' must be [longitude, latitude]"),
        ("metres.geojson", ":1: 'crs' is not WGS 84"),
        ("type.geojson", ":1: 'type' is '[]': only points are supported"), ("none.geojson", ": the file contains no nodes"),
        ("none.gpx", ": the file contains no nodes"),
    )],
    ("fields.deployment", {"kind": "File", "file": "bad/json.geojson"}, "bad/json.geojson:2: not valid JSON"),
    ("fields.movement.kind", "Trace", "'movement.kind' is Trace, which needs a 'deployment' of kind File"),
    ("fields", {"deployment": {"kind": "File", "file": "stations.csv"}, "movement": {"kind": "Trace"}}, "stations.csv:1: the column 'time' is missing"),
    ("fields", {"deployment": {"kind": "File", "file": "cities.geojson"}, "movement": {"kind": "Trace"}}, "cities.geojson: GeoJSON has no times"),
    ("fields", {"deployment": {"kind": "File", "file": "bad/time.gpx"}, "movement": {"kind": "Trace"}}, "bad/time.gpx:3: the point has no time"),
    ("fields", {"deployment": {"kind": "File", "file": "bad/noon.gpx"}, "movement": {"kind": "Trace"}}, "bad/noon.gpx:3: 'time' is '12:00:00Z'; it must have"),
    ("fields", {"deployment": {"kind": "File", "file": "stations.csv"}, "sets": [{"name": "a", "ids": [1]}]},
     "'sets[0].ids' contains node 1, which is not in stations.csv"),
    ("fields.reading", {"expression": "x + tempo"}, "no such column: tempo, at character 5 of 'x + tempo'; columns: id, time, x, y, z"),
    ("fields.reading", {"expression": "x + random()"}, "not authorized to use function: random"),
    ("fields.reading", {"expression": "x, z"}, "row value misused"),
    ("fields.reading", {"expression": "(select count(*) from nodes)"}, "no such table: nodes"),
    ("fields.reading", {"expression": "'warm'"}, "it must not contain texts"),
    ("fields.reading", {"expression": "x", "file": "values.csv"}, "'reading' needs either 'expression' or 'file'"),
    ("fields.reading", {"file": "bad/values.csv"}, "'reading.file': bad/values.csv:3: the time must be after that of line 2, or the id must differ"),
    ("fields.reading", {"file": "bad/all.csv"}, "'reading.file': bad/all.csv:2: 'id' must be a whole number of at least 0"),
    ("fields.reading", {"file": "bad/value.csv"}, "'reading.file': bad/value.csv:1: the column 'value' is missing"),
]


class Study:
    """A project without C#, prepared for runs."""

    def __init__(self, folder: Path):
        self.folder = folder
        (folder / "programs").mkdir()
        (folder / "programs/First.kt").write_text(PROGRAM)
        for name, text in DATA.items():
            (folder / "data" / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / "data" / name).write_text(text)
        (folder / "scenario.json").write_text(json.dumps(SCENARIO, indent=1))
        self.bundle = folder / "bundle"
        self.bundle.mkdir()
        subprocess.run(["python3", "-I", ROOT / "scripts/build/bundle.py", folder / "scenario.json", self.bundle], check=True)
        self.paths = json.loads((self.bundle / "inputs.json").read_text())["paths"]
        self.worker = Worker(str(self.bundle), str(folder / "worker.txt"))

    def write(self, scenario: dict[str, Any]) -> str:
        """Writes the scenario of the study, and returns its text."""
        text = json.dumps({**scenario, **self.paths}, indent=1)
        (self.bundle / "inputs/scenario.json").write_text(text)
        return text


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Study]:
    prepared = Study(tmp_path_factory.mktemp("study"))
    yield prepared
    prepared.worker.stop()


@pytest.mark.parametrize(("key", "value", "message"), REFUSED, ids=[f"{key}={json.dumps(value)}" for key, value, _ in REFUSED])
def test_an_invalid_key_is_rejected_with_its_position_before_a_run(study: Study, key: str, value: Any, message: str) -> None:
    scenario = copy.deepcopy(SCENARIO)
    part = scenario
    *above, last = key.split(".")
    for name in above:
        part = part.setdefault(name, {})
    part[last] = value
    lines = study.write(scenario).splitlines()
    problem, _ = study.worker.check({})
    assert problem is not None
    assert message in problem
    if (key.startswith("fields.") and key != "fields.crowd") or key.startswith("metrics."):
        line = next(number for number, text in enumerate(lines, 1) if f'"{last}":' in text)
        place = re.search(r"scenario\.json:(\d+)(?::(\d+))?: ", problem)
        assert place is not None
        assert line <= int(place[1]) <= line + len(json.dumps(value, indent=1).splitlines())
        if place[2]:
            character = re.search(r"at character (\d+)", problem)
            at = int(character[1]) - 1 if character else len(value)
            assert int(place[2]) == lines[line - 1].index(json.dumps(value), len(f'  "{last}"')) + 2 + at


def test_checking_a_valid_scenario_returns_its_metrics(study: Study) -> None:
    study.write(SCENARIO)
    assert study.worker.check({"fields.deployment.kind": "Poisson"}) == (None, ["reached", "mean", "sources", "degree_mean"])


def test_errors_outside_a_run_are_reported(study: Study, tmp_path: Path) -> None:
    study.write({**SCENARIO, "seconds": 0.1})
    # Reading this file fails.
    memory = study.bundle / "inputs" / study.paths["data"] / "memory.csv"
    memory.symlink_to("/proc/self/mem")
    problem, _ = study.worker.check({"fields.reading.file": "memory.csv"})
    memory.unlink()
    assert problem is not None
    assert "a file could not be read or written: " in problem
    worker = Worker(str(study.bundle), str(tmp_path / "worker.txt"))
    try:
        assert worker.run({}, "{}", str(tmp_path / "out"), 300, is_repeated=False).status == "complete"
        assert worker._idle is not None
        assert isinstance(worker._idle.request({"out": None}, 60), Outcome)
    finally:
        worker.stop()
    assert "unhandled exception" in (tmp_path / "worker.txt").read_text()


def test_nodes_can_be_added_to_a_live_run(study: Study, tmp_path: Path) -> None:
    study.write({**SCENARIO, "fields": {"deployment": {"nodes": 4}}})
    own_end, player_end = socket.socketpair()
    with own_end, player_end, own_end.makefile("rb") as messages:
        process = subprocess.Popen(
            ["mono-sgen", study.bundle / "csharp/Collektive.Player.exe", "live", study.bundle / "inputs/scenario.json", "--scripts",
             study.bundle / "Scenario.dll", "--jar", programs_jar(str(study.bundle), ""), "--host-jar", study.bundle / "jars/collektive-host.jar",
             "--java-home", java_home(), "--out", tmp_path, "--channel", str(player_end.fileno())], pass_fds=[player_end.fileno()])
        player_end.close()
        ticks, slots = [], 0
        while not ticks or ticks[-1] < ticks[0] + 5:
            (length,) = struct.unpack("<I", messages.read(4))
            text, _, frame = messages.read(length).partition(b"\0")
            event = json.loads(text)
            assert event["event"] in ("header", "frame"), event
            if event["event"] == "header" or event["tick"] == 0:
                continue
            if not ticks:
                own_end.sendall(b'{"add": 2, "at": [1, 0, 1]}\n')
            ticks.append(event["tick"])
            # The first 16 bytes are the range of the answers' values.
            slots = frame[16]
            assert event["errors"] == 0, event["error"]
        own_end.shutdown(socket.SHUT_RDWR)
    process.wait(60)
    assert slots == 6


def test_a_missing_library_is_reported_with_the_command_that_builds_it(study: Study, tmp_path: Path) -> None:
    study.write(SCENARIO)
    shutil.copytree(study.bundle, tmp_path / "bundle")
    (tmp_path / "bundle/csharp/libcollektive_sqlite.so").unlink()
    worker = Worker(str(tmp_path / "bundle"), str(tmp_path / "worker.txt"))
    try:
        problem, _ = worker.check({})
    finally:
        worker.stop()
    assert problem is not None
    assert "the SQL library (libcollektive_sqlite.so) is missing: run ./collektive build runtime" in problem


@pytest.mark.parametrize("settings", [
    {}, {"fields.deployment.kind": "Poisson", "fields.deployment.spacing": 2}, {"fields.deployment.kind": "Disc", "fields.movement.kind": "LevyWalk"},
    {"fields.movement.kind": "Target", "fields.neighbourhood.kind": "LineOfSight"},
    {"fields.movement.kind": "Velocity", "fields.neighbourhood.kind": "Nearest"},
    {"fields.deployment.kind": "File", "fields.deployment.file": "walk%20.gpx", "fields.movement.kind": "Trace", "fields.reading.expression": "exp(-x * time)"},
], ids=lambda settings: json.dumps(settings))
def test_runs_are_reproducible_in_one_process_and_with_two_threads(study: Study, settings: dict[str, Any], tmp_path: Path) -> None:
    study.write(SCENARIO)
    results = []
    for threads in (1, 2, 1):
        out = tmp_path / str(len(results))
        outcome = study.worker.run({**settings, "threads": threads}, "{}", str(out), 300, is_repeated=False)
        assert outcome.status == "complete", outcome.message
        manifest = json.loads((out / "manifest.json").read_text())
        results.append((manifest["digest"], manifest["end"], manifest["nodes"], manifest["converged"]))
    assert results[0] == results[1] == results[2]
    # The process must be reusable for later runs, because neither the scene nor the metrics keep state.
    assert study.worker._idle is not None
    assert not study.worker._idle.is_fresh


def test_metrics_have_the_expected_values(study: Study, tmp_path: Path) -> None:
    scenario = copy.deepcopy(SCENARIO)
    scenario["fields"] = {"deployment": {"nodes": 9, "columns": 3, "spacing": 1}, "neighbourhood": {"radius": 1.1},
                          "sets": [{"name": "other", "ids": [8]}, {"name": "source", "ids": [0], "until": 1}]}
    scenario["metrics"] = {
        "nodes": "count(*)", "links_each": "avg(degree)", "farthest": "max(value)", "answers": "count(value)", "right": "sum(value = x + z)",
        "sources": "total(source)", "others": "sum(sets & 1 = 1)", "clock": "avg(abs(sensor_time - time))", "none": "avg(value) filter (where id < 0)",
        'a "name", ümläut': "max(1e999)", "small": "avg(x) / 3e7"}
    scenario["converged"] = {"farthest": {"from": 4, "to": 4}}
    study.write(scenario)
    assert study.worker.run({"seconds": 0.9}, "{}", str(tmp_path / "early"), 300, is_repeated=False).status == "complete"
    manifest = json.loads((tmp_path / "early/manifest.json").read_text())
    end = manifest["end"]
    assert {name: end[name] for name in ("nodes", "farthest", "answers", "right", "sources", "others", "none")} == \
        {"nodes": 9, "farthest": 4, "answers": 9, "right": 9, "sources": 1, "others": 1, "none": "NaN"}
    assert end["links_each"] == pytest.approx(24 / 9)
    assert end["clock"] == pytest.approx(0.1)
    assert manifest["start"]["answers"] == 0
    assert end['a "name", ümläut'] == "Infinity"
    with (tmp_path / "early/metrics.csv").open() as file:
        (row, *_) = csv.DictReader(file)
    assert list(row)[1:12] == list(scenario["metrics"])
    assert float(row["small"]) == end["small"] == pytest.approx(1 / 3e7, rel=1e-12)
    assert study.worker.run({"seconds": 3, "outputs.interval": 0.1}, "{}", str(tmp_path / "late"), 300, is_repeated=False).status == "complete"
    manifest = json.loads((tmp_path / "late/manifest.json").read_text())
    assert manifest["end"]["sources"] == 0
    assert manifest["converged"]["farthest"] == pytest.approx(0.5)
    assert study.worker.run({"seconds": 3, "outputs.interval": 0.1, "stopWhenConverged": True}, "{}", str(tmp_path / "stopped"), 300,
                            is_repeated=False).status == "complete"
    assert json.loads((tmp_path / "stopped/manifest.json").read_text())["ticks"] == 5
    # The value is in the band at the start, before the first round.
    assert study.worker.run({"seconds": 3, "outputs.interval": 0.2, "stopWhenConverged": True, "converged": {"nodes": {"from": 9}}}, "{}",
                            str(tmp_path / "first"), 300, is_repeated=False).status == "complete"
    manifest = json.loads((tmp_path / "first/manifest.json").read_text())
    assert (manifest["ticks"], manifest["converged"]["nodes"]) == (2, 0)


def test_functions_are_metrics_like_sql(study: Study, tmp_path: Path) -> None:
    functions = {name: {"function": name} for name in ("farthest", "sources", "step")}
    queries = {"sql_farthest": "max(value)", "sql_sources": "total(source)"}
    study.write({**SCENARIO, "metrics": {**functions, **queries}, "outputs": {"interval": 0.5},
                 "converged": {"step": {"from": 1, "to": 1, "seconds": 0.5}},
                 "fields": {"deployment": {"nodes": 9, "columns": 3, "spacing": 1}, "neighbourhood": {"radius": 1.1},
                            "sets": [{"name": "source", "ids": [0], "until": 1.7}]}})
    # The last tick does not coincide with a row of the table.
    assert study.worker.run({"seconds": 2.2}, "{}", str(tmp_path / "out"), 300, is_repeated=False).status == "complete"
    with (tmp_path / "out/metrics.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["second"] for row in rows] == ["0", "0.5", "1", "1.5", "2"]
    assert list(rows[0])[1:6] == ["sql_farthest", "sql_sources", "farthest", "sources", "step"]
    assert [(row["farthest"], row["sources"]) for row in rows[1:]] == [(row["sql_farthest"], row["sql_sources"]) for row in rows[1:]]
    assert [row["step"] for row in rows[:4]] == ["NaN", "1", "1", "1"]
    assert (rows[0]["farthest"], rows[1]["farthest"], rows[-1]["sources"]) == ("NaN", "4", "0")
    manifest = json.loads((tmp_path / "out/manifest.json").read_text())
    assert manifest["converged"]["step"] == pytest.approx(0.5)
    assert manifest["end"]["farthest"] == manifest["end"]["sql_farthest"]


def test_a_function_that_fails_ends_the_run_with_its_place(study: Study, tmp_path: Path) -> None:
    study.write({**SCENARIO, "metrics": {"all": {"function": "late"}}, "converged": {}, "outputs": {"interval": 0.2}})
    result = study.worker.run({"seconds": 1}, "{}", str(tmp_path / "out"), 300, is_repeated=False)
    assert result.status == "failed"
    assert "'metrics.all': the function 'late' failed: java.lang.IllegalStateException: too late" in result.message
    with (tmp_path / "out/metrics.csv").open() as file:
        assert [row["all"] for row in csv.DictReader(file)] == ["NaN", "1", "1"]


@pytest.mark.parametrize(("tolerance", "least", "greatest"), [(None, 0.05, 0.2501), (1, 0.3, 1.0001), (0, 0, 1e-4)])
def test_lengths_of_moving_nodes_are_as_accurate_as_the_tolerance(study: Study, tolerance: float | None, least: float, greatest: float, tmp_path: Path) -> None:
    neighbourhood = {"radius": 5} if tolerance is None else {"radius": 5, "lengthTolerance": tolerance}
    study.write({**SCENARIO, "metrics": {"error": {"function": "error"}}, "converged": {}, "outputs": {"interval": 0.1},
                 "fields": {**SCENARIO["fields"], "neighbourhood": neighbourhood, "churn": {}}})
    assert study.worker.run({"seconds": 2}, "{}", str(tmp_path / "out"), 300, is_repeated=False).status == "complete"
    with (tmp_path / "out/metrics.csv").open() as file:
        errors = [float(row["error"]) for row in csv.DictReader(file)][1:]
    assert least <= max(errors) <= greatest


def test_a_set_has_its_members_from_one_tick_to_another(study: Study, tmp_path: Path) -> None:
    study.write({**SCENARIO, "fields": {"sets": [{"name": "source", "ids": [0], "from": 0.3, "until": 0.8}]}, "outputs": {"interval": 0.1},
                 "metrics": {"sources": "total(source)", "sensed": "max(sensor_time)"}, "converged": {}})
    assert study.worker.run({"seconds": 1}, "{}", str(tmp_path / "out"), 300, is_repeated=False).status == "complete"
    with (tmp_path / "out/metrics.csv").open() as file:
        active = {row["sensed"] for row in csv.DictReader(file) if row["sources"] == "1"}
    # The set is active at 0.3 s, because 0.3 is slightly greater as a float than as a double.
    assert active == {"0.3", "0.4", "0.5", "0.6", "0.7"}


def test_sets_and_readings_change_at_times_that_ticks_meet_with_rounding_errors(study: Study, tmp_path: Path) -> None:
    study.write({**SCENARIO, "fields": {"sets": [{"name": "source", "ids": [0], "from": 1, "until": 2}], "reading": {"file": "thirds.csv"}},
                 "outputs": {"interval": 0.3333333}, "metrics": {"sources": "total(source)", "reading": "max(reading)"}, "converged": {}})
    outcome = study.worker.run({"seconds": 3, "deltaTime": 0.3333333}, "{}", str(tmp_path / "out"), 300, is_repeated=False)
    assert outcome.status == "complete", outcome.message
    with (tmp_path / "out/metrics.csv").open() as file:
        rows = list(csv.DictReader(file))
    # A row shows the sensor data of the tick that ends at its second.
    assert [row["sources"] for row in rows] == ["0", "0", "0", "0", "1", "1", "1", "0", "0", "0"]
    assert [row["reading"] for row in rows[1:]] == ["0"] * 3 + ["5"] * 6


SPEED = "sqrt(pow(sensor_velocity_x, 2) + pow(sensor_velocity_z, 2))"
NEAREST = "(select min(pow(other.x - nodes.x, 2) + pow(other.z - nodes.z, 2)) from nodes other where other.id <> nodes.id)"
# The fields of each scene, the simulated seconds, and the minimum and maximum of each metric at the end.
SCENES: list[tuple[dict[str, Any], float, dict[str, tuple[float, float]]]] = [
    ({"deployment": {"nodes": 6, "columns": 3, "spacing": 2}}, 0.1, {"max(x)": (4, 4), "max(z)": (2, 2), "count(*)": (6, 6)}),
    ({"deployment": {"nodes": 36, "spacing": 2, "disorder": 0.5}}, 0.1, {"max(abs(x - 2 * round(x / 2)))": (0.3, 0.5), "min(abs(z))": (0, 0.5)}),
    ({"deployment": {"kind": "Poisson", "nodes": 40, "spacing": 2, "size": [30, 10]}}, 0.1,
     {f"sqrt(min({NEAREST}))": (2, 3), "max(abs(x))": (10, 15), "max(abs(z))": (3, 5)}),
    ({"deployment": {"kind": "Disc", "nodes": 200, "radius": 5}}, 0.1, {"max(sqrt(x*x + z*z))": (4.7, 5), "avg(sqrt(x*x + z*z))": (3, 3.7)}),
    ({"deployment": {"kind": "Uniform", "nodes": 200, "polygon": [[0, 0], [10, 0], [0, 10]]}}, 0.1,
     {"max(x + z)": (8, 10), "min(min(x, z))": (0, 1), "avg(x)": (2.8, 3.9)}),
    ({"deployment": {"kind": "Uniform", "nodes": 200, "size": [10, 10]}, "obstacles": [{"box": [3, 3], "size": [4, 2]}]}, 0.1,
     {"count(*) filter (where abs(x - 3) <= 2 and abs(z - 3) <= 1)": (0, 0)}),
    # Walls along a polygon reach 0.05 m beyond it.
    ({"deployment": {"kind": "Uniform", "nodes": 200, "size": [3, 3]}, "obstacles": [{"polygon": [[-1, -1], [1, -1], [1, 1], [-1, 1]]}]}, 0.1,
     {"count(*) filter (where abs(x) < 1.049 and abs(z) <= 1)": (0, 0)}),
    # Rounding errors of positions do not remove links. A grid of 20 by 20 nodes has 760 pairs of neighbours.
    ({"deployment": {"nodes": 400, "spacing": 1.1}, "neighbourhood": {"radius": 1.1}}, 0.1, {"sum(degree)": (1520, 1520)}),
    ({"deployment": {"nodes": 400, "spacing": 100.3}, "neighbourhood": {"radius": 100.3}}, 0.1, {"sum(degree)": (1520, 1520)}),
    ({"deployment": {"nodes": 9, "spacing": 2}, "neighbourhood": {"kind": "Nearest", "count": 3}}, 0.1, {"min(degree)": (3, 3)}),
    ({"deployment": {"nodes": 2, "columns": 2, "spacing": 2}, "neighbourhood": {"kind": "LineOfSight"}}, 0.1, {"sum(degree)": (2, 2)}),
    ({"deployment": {"nodes": 2, "columns": 2, "spacing": 2}, "neighbourhood": {"kind": "LineOfSight"},
      "obstacles": [{"polygon": [[1, -1], [1.5, -1], [1.5, 1], [1, 1]]}]}, 0.1, {"sum(degree)": (0, 0)}),
    ({"deployment": {"nodes": 2, "columns": 2, "spacing": 2}, "neighbourhood": {"kind": "LineOfSight"},
      "obstacles": [{"polygon": [[0.65, -1], [1.05, -1], [1.35, 1], [0.95, 1]], "height": 300}]}, 0.1, {"sum(degree)": (0, 0)}),
    ({"movement": {"kind": "RandomWaypoint", "speed": 2}}, 2, {f"max({SPEED})": (1.99, 2.01), "min(min(x, z))": (0, 27), "max(max(x, z))": (0, 27)}),
    ({"movement": {"kind": "LevyWalk", "speed": 2}}, 9, {f"max({SPEED})": (1.9, 2.01), "min(min(x, z))": (0, 27), "max(max(x, z))": (0, 27)}),
    # Steps of 2 mm add up, even where single-precision numbers are multiples of 8 mm.
    ({"deployment": {"kind": "File", "file": "far.csv"}, "movement": {"kind": "RandomWaypoint", "speed": 0.02}}, 5,
     {"total(z) filter (where id = 0)": (100000.09, 100000.11)}),
    ({"deployment": {"kind": "File", "file": "far.csv"}, "movement": {"kind": "LevyWalk", "speed": 0.02}}, 5,
     {"total(z) filter (where id = 0)": (100000.01, 100000.11)}),
    # In a tick, the nodes cross the corridor several times. No reflection may end at its sides.
    ({"deployment": {"kind": "Uniform", "nodes": 200, "size": [1, 50]}, "movement": {"kind": "LevyWalk", "speed": 90, "shortest": 50}}, 2,
     {"sum(abs(x) > 0.4999)": (0, 2), "avg(abs(x))": (0.22, 0.28), "max(abs(x))": (0.45, 0.5), "max(abs(z))": (20, 25)}),
    # The two islands are 22 m apart across the antimeridian.
    ({"deployment": {"kind": "File", "file": "islands.csv"}}, 0.1, {"max(x) - min(x)": (22.2, 22.3), "total(x) filter (where id = 0)": (-11.2, -11.1)}),
    # The widest gap between longitudes, of 170 degrees, is at the antimeridian.
    ({"deployment": {"kind": "File", "file": "world.csv"}}, 0.1,
     {"total(x) filter (where id = 0)": (-1.0564e7, -1.0563e7), "max(x)": (1.0563e7, 1.0564e7)}),
    # The program's target is the origin.
    ({"deployment": {"nodes": 4}, "movement": {"kind": "Target", "speed": 1}}, 2, {f"max({SPEED})": (0.5, 1.01), "max(x)": (1, 2.5)}),
    # The height of the target does not slow the body, whose centre is 2 m above the ground.
    ({"deployment": {"nodes": 2, "columns": 2, "spacing": 10}, "movement": {"kind": "Target", "bodyRadius": 2}}, 5, {"max(x)": (4.95, 5.05)}),
    ({"churn": {"failures": 0.1, "arrivals": 10}}, 5,
     {"count(*) filter (where id < 100)": (45, 75), "count(*) filter (where id >= 100)": (20, 70)}),
    ({"deployment": {"kind": "File", "file": "stations.csv"}, "sets": [{"name": "source", "ids": [7]}]}, 0.1,
     {"count(*)": (2, 2), "max(id)": (7, 7), "total(x) filter (where source)": (1, 1), "total(z) filter (where id = 3)": (4, 4)}),
    # The next results have closed forms. In a square, whose sides cut off parts of the nodes' circles, the mean degree is 19.83 with a standard deviation
    # of 0.4. On a ring of n nodes, a message reaches all nodes after n / 2 rounds.
    ({"deployment": {"kind": "Uniform", "nodes": 400, "size": [30, 30]}, "neighbourhood": {"radius": 4}}, 0.1, {"avg(degree)": (18.8, 20.8)}),
    ({"deployment": {"kind": "File", "file": "ring.csv"}, "neighbourhood": {"radius": 1}, "sets": [{"name": "source", "ids": [0]}]}, 1,
     {"sum(value = 9)": (2, 2), "sum(value = 10)": (0, 0), "avg(degree)": (2, 2)}),
    ({"deployment": {"kind": "File", "file": "ring.csv"}, "neighbourhood": {"radius": 1}, "sets": [{"name": "source", "ids": [0]}]}, 1.1,
     {"max(value)": (10, 10), "sum(value)": (100, 100)}),
    # In a gradient without sources, a message has two paths of 8 bytes, with Unit (0 bytes) and null (1 byte).
    ({"deployment": {"nodes": 9}}, 0.1, {"avg(message_values)": (2, 2), "avg(message_bytes)": (17, 17)}),
    # A degree of latitude is 111195 m long, and at a latitude of 44 degrees, a degree of longitude is 79987 m long.
    ({"deployment": {"kind": "File", "file": "cities.geojson"}}, 0.1,
     {"count(*)": (3, 3), "total(x) filter (where id = 1)": (79.98, 79.99), "min(x) + max(x)": (0, 0), "max(z) - min(z)": (111.1, 111.2)}),
    ({"deployment": {"kind": "File", "file": "walk.csv"}, "movement": {"kind": "Trace"}, "reading": {"file": "values.csv"}}, 1.1,
     {"total(x) filter (where id = 0)": (2.19, 2.21), "total(z)": (6, 6), "sum(reading) filter (where id = 0)": (6, 6),
      "sum(reading) filter (where id = 1)": (7, 7)}),
    ({"deployment": {"kind": "File", "file": "walk.csv"}, "movement": {"kind": "Trace"}}, 2.5, {"total(x)": (4, 4), "total(z)": (9.9, 10.1)}),
    # Nodes arrive in the rectangle around all points, not only around the first ones.
    ({"deployment": {"kind": "File", "file": "walk.csv"}, "movement": {"kind": "Trace"}, "churn": {"arrivals": 100}}, 1,
     {"max(x) filter (where id > 1)": (3.5, 4), "max(z) filter (where id > 1)": (7, 8)}),
    ({"deployment": {"kind": "File", "file": "walk%20.gpx"}, "movement": {"kind": "Trace"}}, 2,
     {"total(x) filter (where id = 0)": (-0.1, 0.1), "total(x) filter (where id = 1)": (-40, -39.9), "max(z) - min(z)": (111.1, 111.2)}),
    ({"deployment": {"kind": "File", "file": "fast.gpx"}, "movement": {"kind": "Trace"}}, 0.1, {"max(x)": (111195, 111195.1)}),
    ({"deployment": {"nodes": 4}, "reading": {"expression": "iif(id = 3, null, 10 * x + z + time)"}}, 1,
     {"max(reading)": (30.85, 30.95), "sum(reading = 0)": (1, 1)}),
]


@pytest.mark.parametrize(("fields", "seconds", "expected"), SCENES, ids=[json.dumps(fields) for fields, *_ in SCENES])
def test_fields_set_node_positions(study: Study, fields: dict[str, Any], seconds: float, expected: dict[str, tuple[float, float]], tmp_path: Path) -> None:
    study.write({**SCENARIO, "fields": fields, "metrics": {sql: sql for sql in expected}, "converged": {}})
    outcome = study.worker.run({"seconds": seconds}, "{}", str(tmp_path / "out"), 300, is_repeated=False)
    assert outcome.status == "complete", outcome.message
    end = json.loads((tmp_path / "out/manifest.json").read_text())["end"]
    for sql, (least, greatest) in expected.items():
        assert least <= end[sql] <= greatest, f"{sql}: {end}"


@pytest.mark.parametrize("kind", ["RandomWaypoint", "LevyWalk"])
def test_random_walks_do_not_depend_on_the_schedule(study: Study, kind: str, tmp_path: Path) -> None:
    study.write({**SCENARIO, "fields": {"movement": {"kind": kind, "speed": 9}}, "metrics": {"x": "sum(x)", "z": "sum(z)"}, "converged": {}})
    ends = []
    for schedule in ("Lockstep", "Asynchronous"):
        outcome = study.worker.run({"schedule": schedule, "timing.period": 0.3}, "{}", str(tmp_path / schedule), 300, is_repeated=False)
        assert outcome.status == "complete", outcome.message
        ends.append(json.loads((tmp_path / schedule / "manifest.json").read_text())["end"])
    assert ends[0] == ends[1]


@pytest.mark.parametrize(("fields", "message"), [
    ({"deployment": {"kind": "Poisson", "nodes": 100, "spacing": 20}}, "the area has no room for 100 nodes: "),
    ({"deployment": {"kind": "Uniform", "polygon": [[0, 0], [1, 0], [2, 0]]}}, "the area has no room for 100 nodes: 0 were placed"),
    ({"deployment": {"nodes": 4}, "obstacles": [{"box": [0, 0], "size": [20, 20]}]}, "obstacles cover all positions of the grid"),
    ({"deployment": {"nodes": 4}, "obstacles": [{"box": [0, 0]}], "sets": [{"name": "a", "ids": [0]}]}, "'sets[0].ids' contains node 0, whose position"),
    ({"deployment": {"nodes": 4}, "obstacles": [{"box": [0, 0]}], "sets": [{"name": "a", "near": [0, 0], "count": 4}]},
     "'sets[0].count' is 4, but obstacles leave 3 nodes"),
    ({"deployment": {"kind": "File", "file": "stations.csv"}, "obstacles": [{"box": [1, 2]}]}, "an obstacle covers node 7 of stations.csv:2"),
])
def test_deployments_without_enough_space_fail_at_the_start(study: Study, fields: dict[str, Any], message: str, tmp_path: Path) -> None:
    study.write({**SCENARIO, "fields": fields})
    outcome = study.worker.run({}, "{}", str(tmp_path / "out"), 300, is_repeated=False)
    assert outcome.status == "failed"
    assert message in outcome.message


def test_a_run_can_be_repeated_from_its_manifest(study: Study, tmp_path: Path) -> None:
    result = subprocess.run([COLLEKTIVE, "run", study.folder / "scenario.json", "--out", tmp_path / "out", "--set", "deployment.nodes=20",
                             "--set", "outputs.replay=true", "--set", "metrics.none=avg(value) filter (where id < 0)"],
                            capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stderr
    manifest = tmp_path / "out/manifest.json"
    assert json.loads(manifest.read_text())["scenario"]["fields"]["deployment"]["nodes"] == 20
    (study.folder / "data/file.txt").write_text("changed")
    header = re.search(r'<script id="replay"[^>]*>([^\n<]*)', (tmp_path / "out/replay.html").read_text())
    assert header is not None
    series = json.loads(gzip.decompress(base64.b64decode(header[1])))["metrics"]["series"]
    assert [chart["name"] for chart in series][:4] == list(SCENARIO["metrics"])
    result = subprocess.run([COLLEKTIVE, "repeat", manifest, "--out", tmp_path / "again"], capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stderr
    assert "data" in result.stdout + result.stderr


@pytest.mark.slow
def test_an_interrupted_run_with_a_metric_in_kotlin_can_be_repeated(study: Study, tmp_path: Path) -> None:
    values = {**SCENARIO, "metrics": {"farthest": {"function": "farthest"}}, "converged": {}, "seconds": 1e6, "outputs": {"interval": 1e6}}
    (study.folder / "interrupted.json").write_text(json.dumps(values))
    command = [COLLEKTIVE, "run", study.folder / "interrupted.json", "--out", tmp_path / "out"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as run:
        assert run.stderr is not None
        assert any("tick " in line for line in run.stderr)
        run.terminate()
        run.communicate(timeout=60)
    assert run.returncode == 143
    manifest = tmp_path / "out/manifest.json"
    assert json.loads(manifest.read_text())["end"] == {"farthest": "NaN"}
    result = subprocess.run([COLLEKTIVE, "repeat", manifest, "--out", tmp_path / "again"], capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stderr


def test_the_folder_of_data_cannot_contain_the_scenario(study: Study, tmp_path: Path) -> None:
    shutil.copytree(study.folder / "programs", tmp_path / "programs")
    (tmp_path / "scenario.json").write_text(json.dumps({**SCENARIO, "data": "."}))
    result = subprocess.run([COLLEKTIVE, "run", tmp_path / "scenario.json", "--out", tmp_path / "out"], capture_output=True, text=True, timeout=300)
    assert result.returncode == 1
    assert "'data' contains the scenario: name a folder that contains only data files" in result.stderr
