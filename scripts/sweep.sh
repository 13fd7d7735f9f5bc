# ./collektive sweep and plot: experiments; what they do is in experiments/.

EXPERIMENTS="$ROOT/experiments"
EXPERIMENTS_PYTHON="$BUILD/experiments/bin/python"

help_sweep() {
  cat <<'H'
usage: ./collektive sweep EXPERIMENT.json [--out DIR] [--jobs N] [--resume] [--csv] [--dry-run] [--time-limit SECONDS] [--trust-jvm]
                         [--ray ADDRESS|auto | --slurm]

Runs a scenario once for each combination of the values that an experiment file gives to its keys: {"version": 1, "scenario": "scenario.json",
"vary": {"fields.nodes": [100, 200], "seed": "1-20"}}. The file is described in Documentation~/experiments.md. Writes to --out (default:
out/NAME): a folder for each run, runs.parquet (a row for each run) and series.parquet (a row for each run and simulated second).
  --jobs N      runs at once (default: the number of processors)
  --resume      goes on with a sweep that was stopped; runs that are complete are not run again
  --csv         writes runs.csv and series.csv, too
  --dry-run     tells how many runs these are and about how long they take, from a trial of two of them
  --time-limit  seconds after which a run is ended (default: 3600)
  --ray         runs on the Ray cluster at ADDRESS; auto: the one that runs here, else one is started for the sweep
  --slurm       runs nothing, but writes an array job for the runs that are not done, slurm.sh
Exit code: 0 all runs are complete; 1 some are not, or the file is wrong; 130 Ctrl-C.
H
}

help_plot() {
  cat <<'H'
usage: ./collektive plot FOLDER

Makes figures of a sweep's tables, in its folder: for each metric its mean and 95 % interval over time for each configuration, and box plots of
its values at the end, as SVG and PDF in figures/, and all of them in figures.html.
H
}

# Python packages from PyPI, in a virtual environment of their own: only who sweeps or plots waits for them.
setup_experiments() {
  once experiments "$(fingerprint "$EXPERIMENTS/requirements.txt") $(python3 --version)" new_environment "$BUILD/experiments" "$EXPERIMENTS/requirements.txt"
}

# The same with what the tests of experiments/ use.
setup_experiments_tests() {
  setup_experiments
  [ -n "${COLLEKTIVE_ALL:-}" ] || setup_ray
  once experiments-tests "$(cat "$BUILD/stamp/experiments") $(fingerprint "$EXPERIMENTS/requirements-test.txt")" \
    add_packages "$BUILD/experiments" "$EXPERIMENTS/requirements-test.txt"
}

cmd_sweep() { experiments sweep "$@"; }

cmd_plot() { experiments plot "$@"; }

# experiments COMMAND ARGUMENT...: without the lock. A sweep runs copies, so that others can build meanwhile.
experiments() {
  setup_system
  setup_experiments
  # Ray is three times as large as all the rest.
  case " $* " in *" --ray "*) setup_ray ;; esac
  experiments_python -m collektive_experiments "$@"
}

setup_ray() {
  setup_experiments
  once ray "$(cat "$BUILD/stamp/experiments") $(fingerprint "$EXPERIMENTS/requirements-ray.txt")" \
    add_packages "$BUILD/experiments" "$EXPERIMENTS/requirements-ray.txt"
}

experiments_python() {
  COLLEKTIVE_JAVA_HOME=$(find_jdk)
  unlock
  export COLLEKTIVE_JAVA_HOME COLLEKTIVE="$ROOT/collektive" PYTHONPATH="$EXPERIMENTS${PYTHONPATH:+:$PYTHONPATH}" PYTHONDONTWRITEBYTECODE=1
  exec "$EXPERIMENTS_PYTHON" "$@"
}

# test_experiments RESULTS: in a run of all suites without the cluster, whose tools take longer to fetch than the rest of the suite.
test_experiments() {
  [ -z "${COLLEKTIVE_ALL:-}" ] || echo "without the Ray cluster: ./collektive test experiments has it" >>"$1/notes"
  experiments_python -m pytest -c "$ROOT/scripts/pytest.ini" --junitxml "$1/experiments.xml" --durations 8 "$EXPERIMENTS/tests" \
    ${COLLEKTIVE_ALL:+--ignore="$EXPERIMENTS/tests/test_cluster.py"}
}

# sweep_bundle SCENARIO FOLDER [--trust-jvm]: builds what runs of a scenario need, and copies it to a folder.
sweep_bundle() {
  local scenario=$1 folder=$2 plan jar dll file
  shift 2
  build_all
  plan=$(managed mono-sgen "$CSHARP/Collektive.Player.exe" plan "$scenario" "$@")
  jar=$(programs_jar "$(planned "$plan" schema)" "$(planned "$plan" programs)" "$(planned "$plan" runtime_jars)" "$(planned "$plan" runtime_plugin)")
  dll=$(scripts_dll "$(planned "$plan" schema)" "$(planned "$plan" scripts)")
  mkdir "$folder/csharp" "$folder/native" "$folder/jars"
  for file in Collektive.{FlatBuffers,Bridge,Unity}.dll UnityEngine.dll Newtonsoft.Json.dll libcollektive_physics.so Collektive.Player.exe; do
    cp "$CSHARP/$file" "$folder/csharp/"
  done
  cp "$CSHARP"/Collektive.{Bridge,Unity,Player}.pdb "$CSHARP/UnityEngine.pdb" "$folder/csharp/"
  cp "$SHIM"/libcollektive_shim.so "$folder/native/"
  cp "$HOST_JAR" "$LIBRARY_JAR" "$ADAPTER_JAR" "$folder/jars/"
  cp "$jar" "$folder/programs.jar"
  cp "${dll%.dll}".* "$folder/"
}
