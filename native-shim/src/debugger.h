/* Options of the debugger agent, jdwp. */
#ifndef COLLEKTIVE_DEBUGGER_H
#define COLLEKTIVE_DEBUGGER_H

/* Returns why a JVM option that loads the debugger agent is rejected, or NULL if it is allowed or loads no debugger agent.
 * Static text. Any thread. */
const char *debugger_problem(const char *option);

#endif
