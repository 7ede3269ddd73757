#include "hamilcar/program/executable_memory.hpp"

#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace hamilcar::program {

namespace {

[[noreturn]] void refuse(int error) {
    throw std::runtime_error(std::string("this system gives no memory that may be executed: ") + std::strerror(error));
}

}  // namespace

ExecutableMemory::ExecutableMemory(std::span<const std::byte> code) : data_(MAP_FAILED), size_(code.size()) {
    data_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (data_ == MAP_FAILED) refuse(errno);
    std::memcpy(data_, code.data(), size_);
    if (mprotect(data_, size_, PROT_READ | PROT_EXEC) != 0) {
        const int error = errno;
        munmap(data_, size_);
        refuse(error);
    }
}

ExecutableMemory::~ExecutableMemory() {
    munmap(data_, size_);
}

}  // namespace hamilcar::program
