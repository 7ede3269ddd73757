#include "hamilcar/program/pass.hpp"

#include <algorithm>
#include <array>

#include "hamilcar/base/assert.hpp"

namespace hamilcar::program {

namespace {

std::size_t at(Id id) {
    return static_cast<std::size_t>(id);
}

// Whether an output needs each node. Nodes refer to earlier ones only, so one backward pass finds all.
std::vector<bool> needed(const Graph& graph) {
    std::vector<bool> found(at(graph.size()), false);
    const auto mark = [&](Id id) { found[at(id)] = true; };
    for (const Output& output : graph.outputs()) mark(output.node);
    for (Id id = graph.size() - 1; id >= 0; --id) {
        if (!found[at(id)]) continue;
        const Node& node = graph.node(id);
        if (node.op == Op::call) {
            std::ranges::for_each(graph.calls()[at(node.a)].arguments, mark);
        } else if (node.op == Op::merge) {
            const Region& region = graph.regions()[at(node.a)];
            mark(region.condition);
            mark(region.defaults[at(node.b)]);
            mark(region.results[at(node.b)]);
        } else {
            const int count = operand_count(node.op);
            if (count > 0) mark(node.a);
            if (count > 1) mark(node.b);
            if (count > 2) mark(node.c);
        }
    }
    return found;
}

// A node of the old graph in the new one: as it is, or number by number.
using Numbers = std::array<Id, 4>;

// Rebuilds a graph from another. Every node is added by the new graph's own rules, so that folding and sharing happen once
// more.
class Rewriting {
public:
    Rewriting(const Graph& from, std::vector<bool> kept, bool single)
        : from_(from), to_(from.precision()), kept_(std::move(kept)), single_(single), new_ids_(at(from.size())) {}

    Graph result() && {
        std::size_t next_region = 0;
        for (Id id = 0; id <= from_.size(); ++id) {
            // Before the node: the region that ends here, and then those that begin (and the empty ones among them end).
            while (true) {
                if (open_ != nullptr && open_->last == id) {
                    end_region();
                } else if (next_region < from_.regions().size() && from_.regions()[next_region].first == id &&
                           open_ == nullptr) {
                    if (id < from_.size()) to_.set_block(from_.node(id).block);
                    begin_region(static_cast<Id>(next_region++));
                } else {
                    break;
                }
            }
            if (id == from_.size()) break;
            to_.set_block(from_.node(id).block);
            if (kept_[at(id)]) new_ids_[at(id)] = rewritten(id);
        }
        for (const Output& output : from_.outputs()) {
            HAMILCAR_ASSERT(from_.node(output.node).width == 1);
            to_.output(output.array, output.index, new_ids_[at(output.node)][0]);
        }
        return std::move(to_);
    }

private:
    int numbers(Id id) const { return single_ ? from_.node(id).width : 1; }
    Id number(Id id, int i) const { return new_ids_[at(id)][at(i)]; }

    Numbers rewritten(Id id) {
        const Node& node = from_.node(id);
        Numbers anew{};
        switch (node.op) {
            case Op::constant:
                if (!single_) return {to_.constant(from_.constants(node))};
                for (int i = 0; i < node.width; ++i) anew[at(i)] = to_.constant(from_.constants(node)[at(i)]);
                return anew;
            case Op::input: return {to_.input(node.a, node.b)};
            case Op::truth: anew.fill(to_.truth(node.a != 0, single_ ? 1 : node.width)); return anew;
            case Op::join: return joined(node);
            case Op::part: return {single_ ? number(node.a, node.b) : to_.add(Op::part, number(node.a, 0), node.b)};
            case Op::call: return {call(from_.calls()[at(node.a)])};
            case Op::result: return {number(node.a, 0) + node.b};
            case Op::merge: return new_ids_[at(id)];  // already done at the region's end
            default: break;
        }
        const int count = operand_count(node.op);
        for (int i = 0; i < numbers(id); ++i) {
            anew[at(i)] = to_.add(node.op, number(node.a, i), count > 1 ? number(node.b, i) : none,
                                  count > 2 ? number(node.c, i) : none);
        }
        return anew;
    }

    Numbers joined(const Node& node) {
        if (!single_) return {to_.add(Op::join, number(node.a, 0), number(node.b, 0))};
        const int half = node.width / 2;
        Numbers both{};
        for (int i = 0; i < half; ++i) {
            both[at(i)] = number(node.a, i);
            both[at(half + i)] = number(node.b, i);
        }
        return both;
    }

    // Returns the first result.
    Id call(const Call& old) {
        std::vector<Id> arguments;
        for (const Id argument : old.arguments) arguments.push_back(number(argument, 0));
        return to_.call(old.function, old.detail, arguments, old.result_count);
    }

    void begin_region(Id index) {
        merges_of_open_ = merges(index);
        const Region& region = from_.regions()[at(index)];
        if (merges_of_open_.empty()) {  // neither its results nor any node in it is needed
            std::fill(kept_.begin() + region.first, kept_.begin() + region.last, false);
            return;
        }
        open_ = &region;
        Id condition = number(open_->condition, 0);
        for (int i = 1; i < numbers(open_->condition); ++i) {
            condition = to_.add(Op::either, condition, number(open_->condition, i));
        }
        to_.begin_region(condition);
    }

    // The kept merges of a region; they follow it.
    std::vector<Id> merges(Id index) const {
        const Region& region = from_.regions()[at(index)];
        std::vector<Id> found;
        for (Id id = region.last; id < region.last + static_cast<Id>(region.results.size()); ++id) {
            if (kept_[at(id)]) found.push_back(id);
        }
        return found;
    }

    void end_region() {
        std::vector<Id> defaults, results;
        for (const Id merge : merges_of_open_) {
            const auto which = at(from_.node(merge).b);
            for (int i = 0; i < numbers(merge); ++i) {
                defaults.push_back(number(open_->defaults[which], i));
                results.push_back(number(open_->results[which], i));
            }
        }
        to_.set_block(from_.node(merges_of_open_.front()).block);
        const std::vector<Id> merged = to_.end_region(defaults, results);
        auto next = merged.begin();
        for (const Id merge : merges_of_open_) {
            for (int i = 0; i < numbers(merge); ++i) new_ids_[at(merge)][at(i)] = *next++;
        }
        open_ = nullptr;
    }

    const Graph& from_;
    Graph to_;
    std::vector<bool> kept_;
    bool single_;
    std::vector<Numbers> new_ids_;  // of each old node; of a call, its first result
    const Region* open_ = nullptr;
    std::vector<Id> merges_of_open_;  // old nodes
};

}  // namespace

Graph without_dead_code(const Graph& graph) {
    return Rewriting(graph, needed(graph), false).result();
}

Graph in_single_numbers(const Graph& graph) {
    return Rewriting(graph, std::vector<bool>(at(graph.size()), true), true).result();
}

}  // namespace hamilcar::program
