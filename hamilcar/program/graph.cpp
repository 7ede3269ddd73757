#include "hamilcar/program/graph.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "hamilcar/base/assert.hpp"

namespace hamilcar::program {

int operand_count(Op op) {
    switch (op) {
        case Op::constant:
        case Op::input:
        case Op::truth:
        case Op::call:
        case Op::merge: return 0;
        case Op::square_root:
        case Op::negate:
        case Op::absolute:
        case Op::opposite:
        case Op::part:
        case Op::result: return 1;
        case Op::select: return 3;
        default: return 2;
    }
}

namespace {

template <class Number>
double computed(Op op, Number a, Number b) {
    switch (op) {
        case Op::add: return a + b;
        case Op::subtract: return a - b;
        case Op::multiply: return a * b;
        case Op::divide: return a / b;
        case Op::square_root: return std::sqrt(a);
        case Op::negate: return -a;
        case Op::absolute: return std::fabs(a);
        case Op::minimum: return a < b ? a : b;
        case Op::maximum: return b < a ? a : b;
        case Op::less: return a < b;
        case Op::less_equal: return a <= b;
        case Op::equal: return a == b;
        case Op::not_less: return !(a < b);
        case Op::not_less_equal: return !(a <= b);
        case Op::not_equal: return !(a == b);
        default: HAMILCAR_ASSERT(false); return 0;
    }
}

bool is_commutative(Op op) {
    return op == Op::add || op == Op::multiply || op == Op::equal || op == Op::not_equal || op == Op::both ||
           op == Op::either;
}

Op opposite_of(Op op) {
    switch (op) {
        case Op::less: return Op::not_less;
        case Op::less_equal: return Op::not_less_equal;
        case Op::equal: return Op::not_equal;
        case Op::not_less: return Op::less;
        case Op::not_less_equal: return Op::less_equal;
        case Op::not_equal: return Op::equal;
        default: return Op::opposite;
    }
}

// Whether the numbers are equal bit by bit.
bool equal_bits(std::span<const double> a, std::span<const double> b) {
    return std::ranges::equal(
        a, b, [](double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); });
}

constexpr std::size_t mix(std::size_t hash, std::size_t more) {
    return (std::rotl(hash, 5) ^ more) * 0x9e3779b97f4a7c15ULL;
}

}  // namespace

Id Graph::constant(double value, int width) {
    const std::array<double, 4> same{value, value, value, value};
    return constant(std::span(same).first(static_cast<std::size_t>(width)));
}

Id Graph::constant(std::span<const double> values) {
    const auto index = static_cast<Id>(pool_.size());
    for (const double value : values) {
        pool_.push_back(precision_ == Precision::single_precision ? static_cast<float>(value) : value);
    }
    const Id before = size();
    const Id id = shared({.op = Op::constant, .width = static_cast<std::uint8_t>(values.size()), .a = index});
    if (size() == before) pool_.resize(static_cast<std::size_t>(index));  // it was there
    return id;
}

Id Graph::input(int array, int index) {
    HAMILCAR_ASSERT(array < max_arrays);
    return shared({.op = Op::input, .a = array, .b = index});
}

Id Graph::truth(bool value, int width) {
    return shared({.op = Op::truth, .width = static_cast<std::uint8_t>(width), .a = value});
}

bool Graph::is_constant(Id id, double value) const {
    if (!is_constant(id)) return false;
    return std::ranges::all_of(constants(node(id)), [&](double x) { return x == value; });
}

Id Graph::add(Op op, Id a, Id b, Id c) {
    const Id simpler = simplified(op, a, b, c);
    if (simpler != none) return simpler;
    if (is_commutative(op) && b < a) std::swap(a, b);
    std::uint8_t width = node(op == Op::select ? b : a).width;
    if (op == Op::join) width = static_cast<std::uint8_t>(2 * width);
    if (op == Op::part) width = 1;
    return shared({.op = op, .width = width, .a = a, .b = b, .c = c});
}

Id Graph::simplified(Op op, Id a, Id b, Id c) {
    switch (op) {
        case Op::add: return simplified_sum(a, b);
        case Op::subtract: return simplified_difference(a, b);
        case Op::multiply: return simplified_product(a, b);
        case Op::divide:
            if (is_constant(b, 1)) return a;
            return folded(op, a, b);
        case Op::negate:
            if (node(a).op == Op::negate) return node(a).a;
            return folded(op, a, a);
        case Op::absolute:
            if (node(a).op == Op::absolute) return a;
            if (node(a).op == Op::negate) return add(Op::absolute, node(a).a);
            return folded(op, a, a);
        case Op::select:
            if (b == c || is_truth(a, true)) return b;
            if (is_truth(a, false)) return c;
            return none;
        case Op::join:
            if (is_constant(a) && is_constant(b)) {
                std::vector<double> values(constants(node(a)).begin(), constants(node(a)).end());
                values.insert(values.end(), constants(node(b)).begin(), constants(node(b)).end());
                return constant(values);
            }
            if (node(a).op == Op::truth && node(b).op == Op::truth && node(a).a == node(b).a) {
                return truth(node(a).a != 0, 2 * node(a).width);
            }
            return none;
        case Op::part: return simplified_part(a, b);
        case Op::both:
        case Op::either:
        case Op::opposite: return simplified_condition(op, a, b);
        default: return folded(op, a, operand_count(op) > 1 ? b : a);
    }
}

// Folds two constants.
Id Graph::folded(Op op, Id a, Id b) {
    if (!is_constant(a) || !is_constant(b)) return none;
    const std::span<const double> x = constants(node(a)), y = constants(node(b));
    std::array<double, 4> result{};
    for (std::size_t i = 0; i < x.size(); ++i) {
        result[i] = precision_ == Precision::single_precision
                        ? computed(op, static_cast<float>(x[i]), static_cast<float>(y[i]))
                        : computed(op, x[i], y[i]);
    }
    const std::span<const double> found = std::span(result).first(x.size());
    if (!is_condition(op)) return constant(found);
    if (std::ranges::adjacent_find(found, std::not_equal_to()) != found.end()) return none;  // differs between numbers
    return truth(found[0] != 0, static_cast<int>(x.size()));
}

Id Graph::simplified_sum(Id a, Id b) {
    if (is_constant(a, 0)) return b;
    if (is_constant(b, 0)) return a;
    if (node(b).op == Op::negate) return add(Op::subtract, a, node(b).a);
    if (node(a).op == Op::negate) return add(Op::subtract, b, node(a).a);
    return folded(Op::add, a, b);
}

Id Graph::simplified_difference(Id a, Id b) {
    if (is_constant(b, 0)) return a;
    if (is_constant(a, 0)) return add(Op::negate, b);
    if (node(b).op == Op::negate) return add(Op::add, a, node(b).a);
    return folded(Op::subtract, a, b);
}

Id Graph::simplified_product(Id a, Id b) {
    if (const Id both_known = folded(Op::multiply, a, b); both_known != none) return both_known;
    if (is_constant(a)) std::swap(a, b);
    if (is_constant(b, 0)) return constant(0, node(b).width);
    if (is_constant(b, 1)) return a;
    if (is_constant(b, -1)) return add(Op::negate, a);
    return none;
}

Id Graph::simplified_condition(Op op, Id a, Id b) {
    const int width = node(a).width;
    if (op == Op::opposite) {
        if (node(a).op == Op::truth) return truth(node(a).a == 0, width);
        if (node(a).op == Op::opposite) return node(a).a;
        const Op other = opposite_of(node(a).op);
        return other == Op::opposite ? none : add(other, node(a).a, node(a).b);
    }
    const bool neutral = op == Op::both;  // the value that changes nothing; the other one decides the result
    if (a == b || is_truth(b, neutral)) return a;
    if (is_truth(a, neutral)) return b;
    if (is_truth(a, !neutral) || is_truth(b, !neutral)) return truth(!neutral, width);
    return none;
}

Id Graph::simplified_part(Id a, int which) {
    const Node from = node(a);
    if (from.width == 1) return a;
    switch (from.op) {
        case Op::constant: return constant(constants(from)[static_cast<std::size_t>(which)]);
        case Op::truth: return truth(from.a != 0, 1);
        case Op::join: {
            const int half = from.width / 2;
            return add(Op::part, which < half ? from.a : from.b, which % half);
        }
        default: return none;
    }
}

Id Graph::call(int function, int detail, std::span<const Id> arguments, int result_count) {
    calls_.push_back({function, detail, result_count, {arguments.begin(), arguments.end()}});
    const Id call = append({.op = Op::call, .width = 1, .a = static_cast<Id>(calls_.size()) - 1});
    for (int i = 0; i < result_count; ++i) append({.op = Op::result, .a = call, .b = i});
    return call + 1;
}

void Graph::begin_region(Id condition) {
    HAMILCAR_ASSERT(!in_region_);
    regions_.push_back({condition, size(), size(), {}, {}});
    in_region_ = true;
}

std::vector<Id> Graph::end_region(std::span<const Id> defaults, std::span<const Id> results) {
    Region& region = regions_.back();
    region.last = size();
    region.defaults.assign(defaults.begin(), defaults.end());
    region.results.assign(results.begin(), results.end());
    in_region_ = false;
    for (const std::size_t at : region_entries_)
        table_[at] = none;  // the latest entries, so that no other one was displaced by them
    table_used_ -= region_entries_.size();
    region_entries_.clear();
    std::vector<Id> merged;
    for (std::size_t i = 0; i < defaults.size(); ++i) {
        merged.push_back(append({.op = Op::merge,
                                 .width = node(defaults[i]).width,
                                 .a = static_cast<Id>(regions_.size()) - 1,
                                 .b = static_cast<Id>(i)}));
    }
    return merged;
}

bool Graph::operator==(const Graph& other) const {
    return precision_ == other.precision_ && nodes_ == other.nodes_ && equal_bits(pool_, other.pool_) &&
           calls_ == other.calls_ && regions_ == other.regions_ && outputs_ == other.outputs_;
}

Id Graph::append(const Node& node) {
    nodes_.push_back(node);
    nodes_.back().block = block_;
    nodes_.back().in_region = in_region_;
    return size() - 1;
}

// An equal node if there is one, else this one as a new node. Block and region do not matter.
Id Graph::shared(Node node) {
    if (2 * (table_used_ + 1) > table_.size()) grow_table();
    const auto same = [&](const Node& other) {
        if (other.op != node.op || other.width != node.width) return false;
        if (node.op == Op::constant) return equal_bits(constants(other), constants(node));
        return other.a == node.a && other.b == node.b && other.c == node.c;
    };
    const std::size_t mask = table_.size() - 1;
    std::size_t at = hash(node) & mask;
    for (; table_[at] != none; at = (at + 1) & mask) {
        if (same(this->node(table_[at]))) return table_[at];
    }
    if (in_region_) region_entries_.push_back(at);
    ++table_used_;
    return table_[at] = append(node);
}

std::size_t Graph::hash(const Node& node) const {
    std::size_t h = static_cast<std::size_t>(node.op) * 8 + node.width;
    if (node.op == Op::constant) {
        for (const double value : constants(node)) h = mix(h, std::bit_cast<std::uint64_t>(value));
    } else {
        for (const Id id : {node.a, node.b, node.c}) h = mix(h, static_cast<std::size_t>(id) + 1);
    }
    return mix(h ^ h >> 32, 0) >> 32;  // simple constants differ in their upper bits alone
}

// Rebuilds the table from all nodes that may be shared here; those of regions already ended may not.
void Graph::grow_table() {
    table_.assign(std::max(smallest_table, 2 * table_.size()), none);
    table_used_ = 0;
    region_entries_.clear();
    const Id open = in_region_ ? regions_.back().first : size();
    for (Id id = 0; id < size(); ++id) {
        const Node& one = node(id);
        if (one.op >= Op::call || (one.in_region && id < open)) continue;
        std::size_t at = hash(one) & (table_.size() - 1);
        while (table_[at] != none) at = (at + 1) & (table_.size() - 1);
        if (one.in_region) region_entries_.push_back(at);
        table_[at] = id;
        ++table_used_;
    }
}

}  // namespace hamilcar::program
