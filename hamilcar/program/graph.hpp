// A computation as a linear list of operations: recorded by tracing, transformed by passes, run by backends.
//
// Nodes are in the order of execution and refer to earlier ones only. A node has width 1, 2 or 4: that many numbers of one car
// side by side (such as left and right wheel), and each of them in every lane of a backend (a car in each).
// Adding a node folds what is exact, whatever the numbers: both operands constant, x + 0, x - 0, 0 - x, x * 1, x * -1, 0 * x,
// x / 1, a + (-b), -(-x), equal alternatives; and returns an equal node where there is one. Nothing is
// reassociated or fused, so the bits are those of the plain program in every lane of every backend; but for the sign of a zero,
// and for an infinity or a NaN times a constant zero, which is zero here.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hamilcar::program {

enum class Op : std::uint8_t {
    constant,  // a: index in the pool of `width` numbers
    input,     // a: array, b: index in it; width 1
    add,
    subtract,
    multiply,
    divide,
    square_root,
    negate,
    absolute,
    minimum,  // a < b ? a : b, also where they do not compare
    maximum,  // b < a ? a : b
    // Conditions, a truth value per number:
    truth,  // a: 0 or 1 throughout
    less,
    less_equal,
    equal,
    not_less,
    not_less_equal,
    not_equal,
    both,
    either,
    opposite,
    // Numbers again:
    select,  // a: condition; b where it holds, else c
    join,    // a, then b, both of half the width
    part,    // number b of a; width 1, of a condition too
    call,    // a: which of `calls`; no value
    result,  // a: node of a call, b: which result; width 1
    merge,   // a: which of `regions`, b: which result: the region's own where it was entered, else the default
};

// Which block of the paper's Fig. 10 a node was recorded in.
enum class Block : std::uint8_t { none, velocity, momenta, integration };

enum class Precision : std::uint8_t { double_precision, single_precision };

using Id = std::int32_t;
inline constexpr Id none = -1;

struct Node {
    Op op;
    std::uint8_t width = 1;
    Block block = Block::none;
    bool in_region = false;
    Id a = none, b = none, c = none;
    bool operator==(const Node&) const = default;
};

// How many of a, b, c are nodes; the nodes of calls are in their lists.
int operand_count(Op op);
inline bool is_condition(Op op) {
    return op >= Op::truth && op <= Op::opposite;
}

// A function outside the list, called once for all lanes: `arguments` and `results` are stored number by number, each
// for all lanes; `detail` identifies the call to the function. Width 1 throughout.
struct Call {
    int function;  // index into the functions of a run
    int detail;
    int result_count;
    std::vector<Id> arguments;
    bool operator==(const Call&) const = default;
};

// Nodes [first, last) run only if the condition holds in any lane (a wide condition: in any number), and then for all lanes.
// Regions do not nest.
struct Region {
    Id condition, first, last;
    std::vector<Id> defaults, results;
    bool operator==(const Region&) const = default;
};

struct Output {
    int array, index;
    Id node;  // of width 1
    bool operator==(const Output&) const = default;
};

// Arrays that a program reads and writes, each of numbers for all lanes.
inline constexpr int max_arrays = 8;

class Graph {
public:
    explicit Graph(Precision precision = Precision::double_precision) : precision_(precision) {}

    Precision precision() const { return precision_; }
    const std::vector<Node>& nodes() const { return nodes_; }
    const Node& node(Id id) const { return nodes_[static_cast<std::size_t>(id)]; }
    Id size() const { return static_cast<Id>(nodes_.size()); }
    const std::vector<Call>& calls() const { return calls_; }
    const std::vector<Region>& regions() const { return regions_; }
    const std::vector<Output>& outputs() const { return outputs_; }
    // The numbers of a constant node, one per unit of width; in single precision they are singles.
    std::span<const double> constants(const Node& constant) const {
        return std::span(pool_).subspan(static_cast<std::size_t>(constant.a), constant.width);
    }

    Id constant(double value, int width = 1);
    Id constant(std::span<const double> values);
    Id input(int array, int index);
    // An operation on nodes: returns an existing node, a simpler one, or a new one.
    Id add(Op op, Id a, Id b = none, Id c = none);
    Id truth(bool value, int width);
    // The value of a condition, if it is known.
    bool is_truth(Id id, bool value) const { return node(id).op == Op::truth && (node(id).a != 0) == value; }

    // Returns the first of the results, which are consecutive nodes.
    Id call(int function, int detail, std::span<const Id> arguments, int result_count);
    // Nodes added between the two belong to the region. `end_region` returns the merged values.
    void begin_region(Id condition);
    std::vector<Id> end_region(std::span<const Id> defaults, std::span<const Id> results);
    bool in_region() const { return in_region_; }

    void output(int array, int index, Id node) { outputs_.push_back({array, index, node}); }
    void set_block(Block block) { block_ = block; }
    Block block() const { return block_; }
    bool operator==(const Graph& other) const;

private:
    Id simplified(Op op, Id a, Id b, Id c);
    Id simplified_product(Id a, Id b);
    Id simplified_sum(Id a, Id b);
    Id simplified_difference(Id a, Id b);
    Id simplified_condition(Op op, Id a, Id b);
    Id simplified_part(Id a, int which);
    Id folded(Op op, Id a, Id b);
    bool is_constant(Id id) const { return node(id).op == Op::constant; }
    bool is_constant(Id id, double value) const;
    Id shared(Node node);
    Id append(const Node& node);
    void grow_table();
    std::size_t hash(const Node& node) const;

    Precision precision_;
    std::vector<Node> nodes_;
    std::vector<double> pool_;
    std::vector<Call> calls_;
    std::vector<Region> regions_;
    std::vector<Output> outputs_;
    Block block_ = Block::none;
    bool in_region_ = false;
    static constexpr std::size_t smallest_table = 1 << 12;
    std::vector<Id> table_;  // open addressing by hash(node)
    std::size_t table_used_ = 0;
    std::vector<std::size_t> region_entries_;  // indices in the table that the open region has taken
};

}  // namespace hamilcar::program
