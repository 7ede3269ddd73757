// Memory that holds generated code: written once, then readable and executable, and never writable and executable at once.
#pragma once

#include <cstddef>
#include <span>

namespace hamilcar::program {

class ExecutableMemory {
public:
    // Copies the code. Throws std::runtime_error if the system refuses.
    explicit ExecutableMemory(std::span<const std::byte> code);
    ~ExecutableMemory();
    ExecutableMemory(const ExecutableMemory&) = delete;
    ExecutableMemory& operator=(const ExecutableMemory&) = delete;

    const void* data() const { return data_; }

private:
    void* data_;
    std::size_t size_;
};

}  // namespace hamilcar::program
