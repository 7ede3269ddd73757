// What the portable backend walks: operations on blocks of numbers, and the steps between them.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "hamilcar/program/executable.hpp"

namespace hamilcar::program::portable {

// Numbers are read from the scratch memory, from the constants, or straight from the arrays of the frame: the upper bits of an
// operand say which, the lower ones which number there.
using Operand = std::uint32_t;
constexpr int offset_bits = 28;
enum Base : Operand { scratch_base, constants_base, arrays_base };
constexpr int base_count = arrays_base + max_arrays;

constexpr Operand at_place(std::size_t base, std::size_t offset) {
    assert(offset < (std::size_t{1} << offset_bits));
    return static_cast<Operand>(base) << offset_bits | static_cast<Operand>(offset);
}

constexpr Operand base_of(Operand operand) {
    return operand >> offset_bits;
}

constexpr std::size_t offset_of(Operand operand) {
    return operand & ((Operand{1} << offset_bits) - 1);
}

// What a walk reads and writes.
template <class Number>
struct Memory {
    Number* scratch;
    std::array<const Number*, base_count> bases;

    const Number* operator[](Operand operand) const { return bases[base_of(operand)] + offset_of(operand); }
};

// A condition is a number of zero bits or of ones, so that it stands where numbers do and chooses by `and` and `or`.
template <class Number>
using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;

template <class Number>
Bits<Number> bits(Number number) {
    return std::bit_cast<Bits<Number>>(number);
}

template <class Number>
Number truth_number(bool holds) {
    return std::bit_cast<Number>(holds ? ~Bits<Number>{0} : Bits<Number>{0});
}

// One operation on a block of numbers. The result never overlaps an operand.
struct Operation {
    std::uint32_t result;  // in the scratch memory
    Operand a, b, c;
};

// Does operations of one kind, on blocks of as many numbers as it knows.
template <class Number>
using Work = void (*)(const Memory<Number>& memory, const Operation* first, const Operation* last);

// For blocks of `count` numbers (1, 2, 4, 8 or 16); for what is no operation on numbers, a copy of `a`.
template <class Number>
Work<Number> work(Op op, int count);

// Operations [first, last) of one kind: a walk that jumps to another kind at every operation waits for its jumps, which no
// processor foresees.
template <class Number>
struct Group {
    Work<Number> work;
    std::size_t first, last;
};

// Groups [first, last), and what follows them.
struct Step {
    enum class Then : std::uint8_t { go_on, enter_region, go_to, call };

    std::size_t first, last;
    Then then = Then::go_on;
    Operand condition = 0;                   // of a region
    int numbers = 0;                         // in it
    std::size_t target = 0;                  // step to go to, of a region where the condition holds nowhere
    int function = 0, detail = 0;            // of a call
    std::size_t arguments = 0, results = 0;  // in the scratch memory
};

// An output, once all is done.
struct Store {
    int array;
    std::size_t offset;
    Operand from;
};

// A list ready to be walked, by many threads at once: it does not change.
template <class Number>
struct Code {
    int lanes;
    std::vector<Operation> operations;
    std::vector<Group<Number>> groups;
    std::vector<Step> steps;
    std::vector<Store> stores;
    std::vector<Number> constants;
    std::size_t scratch_numbers = 0;

    void walk(const Frame& frame, Number* scratch) const;
};

// The nodes in an order that has those of one kind beside one another where it can, and each after its operands. Regions and calls
// stay where they are, and no node moves far: what is computed early takes room in the cache until it is needed.
std::vector<Id> order_by_kind(const Graph& graph);

// From a graph to code, for so many lanes.
template <class Number>
Code<Number> translated(const Graph& graph, int lanes);

}  // namespace hamilcar::program::portable
