// The code that the portable backend interprets: operations on blocks of numbers, and the steps between them.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/program/executable.hpp"

namespace hamilcar::program::portable {

// Numbers are read from the scratch memory, from the constants, or directly from the arrays of the frame: the upper bits of an
// operand select the memory, the lower ones the number in it.
using Operand = std::uint32_t;
constexpr int offset_bits = 28;
enum Base : Operand { scratch_base, constants_base, arrays_base };
constexpr int base_count = arrays_base + max_arrays;

constexpr Operand operand_at(std::size_t base, std::size_t offset) {
    HAMILCAR_ASSERT(offset < (std::size_t{1} << offset_bits));
    return static_cast<Operand>(base) << offset_bits | static_cast<Operand>(offset);
}

constexpr Operand base_of(Operand operand) {
    return operand >> offset_bits;
}

constexpr std::size_t offset_of(Operand operand) {
    return operand & ((Operand{1} << offset_bits) - 1);
}

// The memory that a walk reads and writes.
template <class Number>
struct Memory {
    Number* scratch;
    std::array<const Number*, base_count> bases;

    const Number* operator[](Operand operand) const { return bases[base_of(operand)] + offset_of(operand); }
};

// A condition is a number with all bits clear or all set, so that it is stored like numbers and selects by `and` and `or`.
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

// Executes operations of one kind on blocks of a fixed size.
template <class Number>
using Work = void (*)(const Memory<Number>& memory, const Operation* first, const Operation* last);

// For blocks of `count` numbers (1, 2, 4, 8 or 16); for anything but an operation on numbers, a copy of `a`.
template <class Number>
Work<Number> work(Op op, int count);

// Operations [first, last) of one kind: a jump to another kind at every operation would be mispredicted by the processor.
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
    std::size_t target = 0;                  // of a region: the step to go to if the condition holds nowhere
    int function = 0, detail = 0;            // of a call
    std::size_t arguments = 0, results = 0;  // in the scratch memory
};

// An output, stored at the end.
struct Store {
    int array;
    std::size_t offset;
    Operand from;
};

// The code, which may be walked by many threads at once since it does not change.
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

// The nodes in an order that groups those of one kind where possible, each after its operands. Regions and calls stay where
// they are, and no node moves far: values computed early occupy the cache until they are used.
std::vector<Id> order_by_kind(const Graph& graph);

// From a graph to code for `lanes` lanes.
template <class Number>
Code<Number> translated(const Graph& graph, int lanes);

}  // namespace hamilcar::program::portable
