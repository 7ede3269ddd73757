// Runs random graphs: their inputs, the functions that they call, and their outputs, compared bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "program/plain_evaluator.hpp"
#include "program/random_graph.hpp"

namespace hamilcar::program::test {

// Numbers for all lanes, aligned as a run requires.
template <class Number>
class Array {
public:
    explicit Array(std::size_t size)
        : size_(size), lines_(std::make_unique<Line[]>(size * sizeof(Number) / sizeof(Line) + 1)) {}
    Number* data() const { return lines_[0].numbers; }
    std::span<Number> all() const { return {data(), size_}; }

private:
    struct alignas(64) Line {
        Number numbers[64 / sizeof(Number)];
    };
    std::size_t size_;
    std::unique_ptr<Line[]> lines_;
};

template <class Number>
const std::vector<Number>& special_numbers() {
    using Limits = std::numeric_limits<Number>;
    static const std::vector<Number> all{0,
                                         -Number{0},
                                         1,
                                         -1,
                                         2,
                                         Number(0.1),
                                         Number(-1e5),
                                         Number(1.5e-7),
                                         Limits::infinity(),
                                         -Limits::infinity(),
                                         Limits::quiet_NaN(),
                                         -Limits::quiet_NaN(),
                                         Limits::max(),
                                         Limits::lowest(),
                                         Limits::min(),
                                         -Limits::min(),
                                         Limits::denorm_min(),
                                         -Limits::denorm_min(),
                                         Limits::epsilon(),
                                         1 + Limits::epsilon()};
    return all;
}

// The same to the bit; a NaN is any NaN.
template <class Number>
bool same_bits(Number a, Number b) {
    if (a != a || b != b) return a != a && b != b;
    return a == b && std::signbit(a) == std::signbit(b);
}

// All vector registers and masks that a function may change, changed.
#if defined(__x86_64__)
__attribute__((target("avx512f,avx512bw"), noinline)) inline void change_all_registers() {
    asm volatile(
        "vpternlogd $255, %%zmm16, %%zmm16, %%zmm16\n vmovdqa64 %%zmm16, %%zmm17\n vmovdqa64 %%zmm16, %%zmm18\n"
        "vmovdqa64 %%zmm16, %%zmm19\n vmovdqa64 %%zmm16, %%zmm20\n vmovdqa64 %%zmm16, %%zmm21\n"
        "vmovdqa64 %%zmm16, %%zmm22\n vmovdqa64 %%zmm16, %%zmm23\n vmovdqa64 %%zmm16, %%zmm24\n"
        "vmovdqa64 %%zmm16, %%zmm25\n vmovdqa64 %%zmm16, %%zmm26\n vmovdqa64 %%zmm16, %%zmm27\n"
        "vmovdqa64 %%zmm16, %%zmm28\n vmovdqa64 %%zmm16, %%zmm29\n vmovdqa64 %%zmm16, %%zmm30\n"
        "vmovdqa64 %%zmm16, %%zmm31\n"
        "kxnorw %%k1, %%k1, %%k1\n kxnorw %%k2, %%k2, %%k2\n kxnorw %%k3, %%k3, %%k3\n kxnorw %%k4, %%k4, %%k4\n"
        "kxnorw %%k5, %%k5, %%k5\n kxnorw %%k6, %%k6, %%k6\n kxnorw %%k7, %%k7, %%k7\n kxnorw %%k0, %%k0, %%k0\n" ::
            : "xmm16", "xmm17", "xmm18", "xmm19", "xmm20", "xmm21", "xmm22", "xmm23", "xmm24", "xmm25", "xmm26",
              "xmm27", "xmm28", "xmm29", "xmm30", "xmm31", "k0", "k1", "k2", "k3", "k4", "k5", "k6", "k7");
}
#endif

inline void change_registers() {
#if defined(__x86_64__)
    asm volatile(
        "pcmpeqd %%xmm0, %%xmm0\n movdqa %%xmm0, %%xmm1\n movdqa %%xmm0, %%xmm2\n movdqa %%xmm0, %%xmm3\n"
        "movdqa %%xmm0, %%xmm4\n movdqa %%xmm0, %%xmm5\n movdqa %%xmm0, %%xmm6\n movdqa %%xmm0, %%xmm7\n"
        "movdqa %%xmm0, %%xmm8\n movdqa %%xmm0, %%xmm9\n movdqa %%xmm0, %%xmm10\n movdqa %%xmm0, %%xmm11\n"
        "movdqa %%xmm0, %%xmm12\n movdqa %%xmm0, %%xmm13\n movdqa %%xmm0, %%xmm14\n movdqa %%xmm0, %%xmm15\n"
        "mov $-1, %%rax\n mov %%rax, %%rcx\n mov %%rax, %%rdx\n mov %%rax, %%rsi\n mov %%rax, %%rdi\n"
        "mov %%rax, %%r8\n mov %%rax, %%r9\n mov %%rax, %%r10\n mov %%rax, %%r11\n" ::
            : "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12",
              "xmm13", "xmm14", "xmm15", "rax", "rcx", "rdx", "rsi", "rdi", "r8", "r9", "r10", "r11");
    static const bool has_more = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw");
    if (has_more) change_all_registers();
#endif
}

// What random graphs call: (1 argument, 1 result), (3, 2), (0, 1), (2, 3). The context is a number.
template <class Number, int which>
void test_function(const void* context, int detail, int lanes, const void* arguments, void* results) {
    static constexpr std::size_t argument_counts[] = {1, 3, 0, 2}, result_counts[] = {1, 2, 1, 3};
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) % 16, 0U) << "the stack is not aligned";
    const auto count = static_cast<std::size_t>(lanes);
    std::array<Number, 3 * 16> found{};
    for (std::size_t lane = 0; lane < count; ++lane) {
        Number sum = static_cast<Number>(detail) + *static_cast<const Number*>(context);
        for (std::size_t i = 0; i < argument_counts[which]; ++i) {
            sum = sum * Number(0.5) + static_cast<const Number*>(arguments)[i * count + lane];
        }
        for (std::size_t i = 0; i < result_counts[which]; ++i) found[i * count + lane] = sum - static_cast<Number>(i);
    }
    std::copy_n(found.begin(), result_counts[which] * count, static_cast<Number*>(results));
    change_registers();
}

template <class Number>
inline constexpr CallFunction test_functions[] = {test_function<Number, 0>, test_function<Number, 1>,
                                                  test_function<Number, 2>, test_function<Number, 3>};

inline std::size_t array_size(const Graph& graph, int array) {
    int count = 0;
    for (const Output& output : graph.outputs()) {
        if (output.array == array) count = std::max(count, output.index + 1);
    }
    for (const Node& node : graph.nodes()) {
        if (node.op == Op::input && node.a == array) count = std::max(count, node.b + 1);
    }
    return static_cast<std::size_t>(count);
}

// The arrays of a run. Special numbers and ordinary ones by a seed: the same ones for the same lanes.
template <class Number>
class Arrays {
public:
    Arrays(const Graph& graph, int lanes, unsigned seed) {
        std::mt19937 random(seed);
        for (int i = 0; i < input_arrays + 1; ++i) {
            arrays_.emplace_back(array_size(graph, i) * static_cast<std::size_t>(lanes));
            frame_.arrays[i] = arrays_.back().data();
            std::ranges::generate(arrays_.back().all(), [&] { return input(random); });
        }
        std::ranges::fill(outputs(), Number(-77));
        frame_.functions = test_functions<Number>;
        frame_.context = &context_;
    }
    Arrays(const Arrays&) = delete;
    Arrays& operator=(const Arrays&) = delete;

    const Frame& frame() const { return frame_; }
    std::span<Number> inputs(int array) const { return arrays_[static_cast<std::size_t>(array)].all(); }
    std::span<Number> outputs() const { return arrays_[output_array].all(); }

private:
    static Number input(std::mt19937& random) {
        const std::vector<Number>& special = special_numbers<Number>();
        if (random() % 4 == 0) return special[random() % special.size()];
        return static_cast<Number>(static_cast<double>(random()) / 1e9 - 2);
    }

    std::vector<Array<Number>> arrays_;
    Frame frame_;
    Number context_ = Number(0.25);
};

template <class Number>
::testing::AssertionResult same_outputs(const Graph& graph, int lanes, std::span<const Number> found,
                                        std::span<const Number> expected) {
    for (const Output& output : graph.outputs()) {
        for (int lane = 0; lane < lanes; ++lane) {
            const auto i = static_cast<std::size_t>(output.index * lanes + lane);
            if (same_bits(found[i], expected[i])) continue;
            return ::testing::AssertionFailure()
                   << "output " << output.index << " (node " << output.node << ", operation "
                   << static_cast<int>(graph.node(output.node).op) << ") in lane " << lane << " is " << found[i]
                   << ", expected " << expected[i];
        }
    }
    return ::testing::AssertionSuccess();
}

// Whether a program computes what its graph says, from inputs by a seed.
template <class Number>
::testing::AssertionResult computes(const Executable& executable, const Graph& graph, unsigned seed) {
    const Arrays<Number> found(graph, executable.lanes(), seed), expected(graph, executable.lanes(), seed);
    executable.run(found.frame());
    PlainEvaluator<Number>(graph, executable.lanes(), expected.frame()).run();
    for (int i = 0; i < input_arrays; ++i) {
        if (!std::ranges::equal(found.inputs(i), expected.inputs(i), same_bits<Number>)) {
            return ::testing::AssertionFailure() << "input array " << i << " was written";
        }
    }
    return same_outputs<Number>(graph, executable.lanes(), found.outputs(), expected.outputs());
}

inline ::testing::AssertionResult computes(const Executable& executable, const Graph& graph, unsigned seed) {
    return graph.precision() == Precision::double_precision ? computes<double>(executable, graph, seed)
                                                            : computes<float>(executable, graph, seed);
}

}  // namespace hamilcar::program::test
