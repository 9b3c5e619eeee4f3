#include "engine/slump/outcome.hpp"

namespace repose {

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::completed:
      return "completed";
    case Outcome::no_heap:
      return "no_heap";
    case Outcome::unreadable:
      return "unreadable";
    case Outcome::timed_out:
      return "timed_out";
    case Outcome::too_long:
      return "too_long";
    case Outcome::overfull:
      return "overfull";
    case Outcome::overlapping:
      return "overlapping";
    case Outcome::escaped:
      return "escaped";
    case Outcome::unstable:
      return "unstable";
    case Outcome::diverged:
      return "diverged";
    case Outcome::interrupted:
      return "interrupted";
  }
  return "unknown";
}

}  // namespace repose
