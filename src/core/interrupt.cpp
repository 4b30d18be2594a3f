#include "core/interrupt.h"

#include <atomic>
#include <csignal>

#include "core/error.h"

namespace nephroid {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch what is lock-free");

extern "C" void onInterrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catchInterrupts() {
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
}

bool isInterrupted() {
  return interrupted;
}

void acknowledgeInterrupt() {
  interrupted = false;
}

void throwIfInterrupted() {
  if (interrupted) throw Interrupted();
}

}  // namespace nephroid
