# ./collektive site: the documentation as a site.

SITE_TOOLS="$BUILD/site-tools"

help_site() {
  cat <<'H'
usage: ./collektive site [--out DIR]

Makes the documentation as a site in --out (default: out/site, where it replaces the former one); open its index.html. The pages are those of
Documentation~ and docs/ and a reference made from the code. The site opens from the disk, searches without a server and loads nothing from
elsewhere. A link that leads nowhere is an error.
H
}

cmd_site() {
  local out="$ROOT/out/site"
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      *) fail "site: unknown argument $1 (see ./collektive site --help)" ;;
    esac
  done
  [ ! -e "$out" ] || [ -f "$out/sitemap.xml" ] || fail "site: '$out' is there and no site: name another folder with --out"
  setup_system
  build_jvm
  build_csharp
  setup_site
  logged "$BUILD/log/site.log" make_site "$out"
  echo "$out/index.html"
}

# MkDocs Material from PyPI, and libraries of the pages from npm.
setup_site() {
  once site-tools "$(fingerprint "$ROOT/tools/site") $(python3 --version)" fetch_site_tools
}

fetch_site_tools() {
  new_environment "$SITE_TOOLS" "$ROOT/tools/site/requirements.txt"
  cp "$ROOT"/tools/site/package.json "$ROOT"/tools/site/package-lock.json "$ROOT"/tools/site/.npmrc "$SITE_TOOLS/"
  (cd "$SITE_TOOLS" && npm ci --ignore-scripts)
}

# make_site OUT: in a folder of its own first, so that several commands can do it at once.
make_site() {
  local out=$1 work code=0
  work=$(mktemp -d)
  documented "$work/xml"
  python3 "$ROOT/scripts/site/pages.py" "$work/pages" "$work/xml" "$SITE_TOOLS/node_modules"
  cp "$ROOT/scripts/site/mkdocs.yml" "$work/"
  (cd "$work" && NO_MKDOCS_2_WARNING=true "$SITE_TOOLS/bin/python" -m mkdocs build --strict --config-file site.yml --site-dir site) || code=$?
  if [ "$code" = 0 ]; then
    rm -rf "$out"
    mkdir -p "$(dirname "$out")"
    mv "$work/site" "$out"
  fi
  rm -rf "$work"
  return "$code"
}

# documented FOLDER: the XML documentation of the package's assemblies.
documented() {
  mkdir -p "$1"
  compile_documented "$1" Bridge "${GENERATED_CODE_SYMBOLS[@]}" "-r:$CSHARP/Collektive.FlatBuffers.dll"
  compile_documented "$1" Unity "${PACKAGE_REFERENCES[@]:0:3}"
}

# moving_picture REPLAY.html FILE.webp: the moving picture of the README, from the replay page of the demo.
moving_picture() {
  local frames
  build_replay_page
  setup_site
  frames=$(mktemp -d)
  COLLEKTIVE_NODE_MODULES="$BUILD/npm/node_modules" node "$ROOT/scripts/site/moving_picture.mjs" "$1" "$frames" 90
  "$SITE_TOOLS/bin/python" "$ROOT/scripts/site/moving_picture.py" "$frames" "$2"
  rm -rf "$frames"
}
