/* Options of the debugger's agent, jdwp. */
#ifndef COLLEKTIVE_DEBUGGER_H
#define COLLEKTIVE_DEBUGGER_H

/* Why an option of the JVM that loads the debugger's agent is refused; NULL for an allowed one and for one that loads no such agent.
 * Static text. Any thread. */
const char *debugger_fault(const char *option);

#endif
