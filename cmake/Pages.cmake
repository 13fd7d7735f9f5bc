# The template of replay pages, into which each run inserts its data.
collektive_step(replay_page OUTPUT "${COLLEKTIVE_BUILD}/replay.html"
  COMMAND "${CMAKE_COMMAND}" -E env "COLLEKTIVE_NODE_MODULES=${COLLEKTIVE_BUILD}/npm/node_modules"
    node "${HEADLESS}/Replay/build.mjs" "${COLLEKTIVE_BUILD}/replay.html"
  DEPENDS "${COLLEKTIVE_BUILD}/stamp/npm" FOLDERS "${HEADLESS}/Replay")
