// The next use of every value: the list is read once, before registers are allocated.
//
// The main line and the bodies of regions have lists of their own. Bodies run rarely, so their uses should not keep a
// register on the main line occupied; but a value lives until both lists have ended.
#pragma once

#include <vector>

#include "hamilcar/program/graph.hpp"
#include "hamilcar/program/x86_registers.hpp"

namespace hamilcar::program::x86 {

// Calls `visit(id)` for every operand, call's arguments among them, as often as it is one.
template <class Visit>
void for_each_operand(const Graph& graph, const Node& node, const Visit& visit) {
    if (node.op == Op::call) {
        for (const Id argument : graph.calls()[static_cast<std::size_t>(node.a)].arguments) visit(argument);
    } else if (node.op != Op::result) {
        const int count = operand_count(node.op);
        if (count > 0) visit(node.a);
        if (count > 1) visit(node.b);
        if (count > 2) visit(node.c);
    }
}

class UseLists {
public:
    explicit UseLists(const Graph& graph);

    int next(Id id, bool in_body) const { return lists_[in_body].next(id, 0); }
    int next_but_one(Id id, bool in_body) const { return lists_[in_body].next(id, 1); }
    void consume(Id id, bool in_body) { ++lists_[in_body].cursors[static_cast<std::size_t>(id)]; }
    bool is_dead(Id id) const { return next(id, false) == never && next(id, true) == never; }
    // Not needed any more except, at most, by the body of this region.
    bool is_for_body_alone(Id id, int region) const {
        return next(id, false) == never && last_regions_[static_cast<std::size_t>(id)] <= region;
    }

private:
    struct List {
        std::vector<int> cursors, ends, positions;

        int next(Id id, int further) const {
            const int at = cursors[static_cast<std::size_t>(id)] + further;
            return at < ends[static_cast<std::size_t>(id)] ? positions[static_cast<std::size_t>(at)] : never;
        }
    };
    template <class Visit>
    static void for_each_use(const Graph& graph, const Visit& visit);

    List lists_[2];                  // of the main line, of the bodies
    std::vector<int> last_regions_;  // whose bodies need a value
};

}  // namespace hamilcar::program::x86
