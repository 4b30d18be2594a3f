// Ctrl-C and SIGTERM. The first one ends the work by an Interrupted exception; the second one ends the
// process.
#pragma once

namespace nephroid {

void catchInterrupts();
bool isInterrupted();
void throwIfInterrupted();
// Clears the interrupt: the work ends early, and what is finished of it is kept.
void acknowledgeInterrupt();

}  // namespace nephroid
