# ./collektive test chaos and --chaos: what is left of runs that are disturbed; see scripts/chaos/chaos.py.

# test_chaos RESULTS: about a minute.
test_chaos() {
  unlock
  python3 "$ROOT/scripts/chaos/chaos.py" 6 3 3 1 --seed "$(date +%j)" --results "$1/chaos.xml"
}

chaos_at_length() {
  build_jvm
  build_csharp
  build_replay_page
  unlock
  python3 "$ROOT/scripts/chaos/chaos.py" 200 20 50 5 --seed "${1:-1}"
}
