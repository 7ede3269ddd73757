// A hardened system, for tests.
#pragma once

namespace hamilcar::test {

// From now on the system refuses executable memory to this process and its children; without `may_map` even mapping it, which
// starting a program requires. Returns false if the system cannot do this.
bool refuse_executable_memory(bool may_map);

}  // namespace hamilcar::test
