# The template of replay pages, into which each run inserts its data, and the pages of running simulations.
collektive_step(replay_page OUTPUT "${COLLEKTIVE_BUILD}/replay.html"
  BYPRODUCTS "${COLLEKTIVE_BUILD}/live.html" "${COLLEKTIVE_BUILD}/live-view.html"
  COMMAND "${CMAKE_COMMAND}" -E env "COLLEKTIVE_NODE_MODULES=${COLLEKTIVE_BUILD}/npm/node_modules"
    node "${HEADLESS}/Replay/build.mjs" "${COLLEKTIVE_BUILD}"
  DEPENDS "${COLLEKTIVE_BUILD}/stamp/npm" FOLDERS "${HEADLESS}/Replay")
