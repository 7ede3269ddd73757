#include "hamilcar/program/x86_backend.hpp"

#if defined(__x86_64__)

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/program/executable_memory.hpp"
#include "hamilcar/program/pass.hpp"
#include "hamilcar/program/x86_lowering.hpp"

namespace hamilcar::program {

namespace {

class MachineCode final : public Executable {
public:
    MachineCode(const x86::Target& target, std::span<const std::byte> code, const CompileReport& report)
        : Executable(target.precision, target.lanes()), memory_(code) {
        entry_ = reinterpret_cast<Entry>(const_cast<void*>(memory_.data()));
        report_ = report;
    }
    void set_seconds(double seconds) { report_.seconds = seconds; }

private:
    ExecutableMemory memory_;
};

class Errors final : public asmjit::ErrorHandler {
public:
    void handleError(asmjit::Error, const char* message, asmjit::BaseEmitter*) override {
        throw std::logic_error(std::string("x86 backend: ") + message);
    }
};

void check(asmjit::Error error) {
    if (error != asmjit::kErrorOk) {
        throw std::logic_error(std::string("x86 backend: ") + asmjit::DebugUtils::errorAsString(error));
    }
}

std::vector<std::byte> linked(asmjit::CodeHolder& code) {
    check(code.flatten());
    check(code.resolveUnresolvedLinks());
    std::vector<std::byte> bytes(code.codeSize());
    check(code.relocateToBase(0));  // nothing in it depends on the address
    check(code.copyFlattenedData(bytes.data(), bytes.size()));
    return bytes;
}

std::unique_ptr<Executable> compile(const Graph& graph, x86::InstructionSet set, bool car_in_each_lane) {
    const auto begin = std::chrono::steady_clock::now();
    const x86::Target target{set, graph.precision(), car_in_each_lane};
    Errors errors;
    asmjit::CodeHolder code;
    check(code.init(asmjit::Environment::host()));
    code.setErrorHandler(&errors);
    x86::Lowering lowering(graph, target, code);
    lowering.run();
    CompileReport report = lowering.report();
    const std::vector<std::byte> bytes = linked(code);
    report.code_bytes = bytes.size() - report.constant_bytes;
    auto executable = std::make_unique<MachineCode>(target, bytes, report);
    executable->set_seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    return executable;
}

}  // namespace

bool has_sse2() {
    return true;
}

bool has_avx2() {
    return __builtin_cpu_supports("avx2");
}

bool has_avx512() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
}

std::unique_ptr<Executable> compile_sse2(const Graph& graph, bool car_in_each_lane) {
    const int number_bytes = graph.precision() == Precision::double_precision ? 8 : 4;
    const bool fits =
        std::ranges::all_of(graph.nodes(), [&](const Node& node) { return node.width * number_bytes <= 16; });
    if (fits || car_in_each_lane) return compile(graph, x86::InstructionSet::sse2, car_in_each_lane);
    return compile(in_single_numbers(graph), x86::InstructionSet::sse2, car_in_each_lane);
}

std::unique_ptr<Executable> compile_avx2(const Graph& graph, bool car_in_each_lane) {
    return compile(graph, x86::InstructionSet::avx2, car_in_each_lane);
}

std::unique_ptr<Executable> compile_avx512(const Graph& graph, bool car_in_each_lane) {
    return compile(graph, x86::InstructionSet::avx512, car_in_each_lane);
}

}  // namespace hamilcar::program

// Debian's AsmJit is an archive whose code may stand in a shared library but for one object, that of these three functions: it
// refers to `stderr` as only programs may. With these the linker has no need of it.
namespace asmjit::DebugUtils {

const char* errorAsString(Error error) noexcept {
    switch (error) {
        case kErrorOutOfMemory: return "out of memory";
        case kErrorInvalidOperandSize: return "operands of different sizes";
        case kErrorInvalidInstruction: return "an instruction with operands that it does not have";
        case kErrorTooLarge: return "too large";
        default: return "AsmJit refuses (the numbers of its errors are in <asmjit/core/globals.h>)";
    }
}

void debugOutput(const char* text) noexcept {
    std::fputs(text, stderr);
}

void assertionFailed(const char* file, int line, const char* condition) noexcept {
    hamilcar::assertion_failed(condition, file, line);
}

}  // namespace asmjit::DebugUtils

#endif
