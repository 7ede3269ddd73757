// A hardened system, for tests.
#pragma once

namespace hamilcar::test {

// From here on the system refuses this process, and what it starts, to make memory executable; unless `may_map`, also to map
// any, which a program that starts must. False where that cannot be had.
bool refuse_executable_memory(bool may_map);

}  // namespace hamilcar::test
