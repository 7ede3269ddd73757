// Fails a test on memory allocation: counts every call of operator new while a guard is alive.
#pragma once

#include <cstdint>

namespace hamilcar::test {

class AllocationGuard {
public:
    AllocationGuard();
    std::int64_t allocations() const;  // since the guard began

private:
    std::int64_t at_start_;
};

}  // namespace hamilcar::test
