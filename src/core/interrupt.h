// Ctrl-C and SIGTERM: asked for once, work is unwound by an Interrupted exception; asked for twice, the
// process ends.
#pragma once

namespace nephroid {

void catchInterrupts();
bool isInterrupted();
void throwIfInterrupted();
// Work is not unwound but ended early, and what there is of it is kept.
void acknowledgeInterrupt();

}  // namespace nephroid
