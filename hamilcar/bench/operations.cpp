#include "hamilcar/bench/operations.hpp"

#include <algorithm>

#include "hamilcar/engine/rhs_program.hpp"

namespace hamilcar {

namespace {

// What a method adds for each number: products, as many sums, and turns.
struct MethodCost {
    int turns, products;
};

int count_products(const Tableau& tableau) {
    const auto nonzero = [](const auto& row) {
        return static_cast<int>(std::ranges::count_if(row, [](double weight) { return weight != 0; }));
    };
    int count = nonzero(tableau.weights);
    for (const auto& row : tableau.stage) count += nonzero(row);
    return count;
}

MethodCost cost_of(const Method& method) {
    switch (method.family) {
        case MethodFamily::adams_bashforth: return {1, method.order};
        case MethodFamily::adams_bashforth_moulton: return {2, 2 * method.order};
        case MethodFamily::runge_kutta: return {classical_runge_kutta.stages, count_products(classical_runge_kutta)};
        case MethodFamily::embedded_runge_kutta: break;
    }
    return {dormand_prince.stages, count_products(dormand_prince)};
}

void count_node(const program::Node& node, OperationCount& count) {
    using program::Op;
    switch (node.op) {
        case Op::add:
        case Op::subtract: count.additions += node.width; break;
        case Op::multiply: count.multiplications += node.width; break;
        case Op::divide: count.divisions += node.width; break;
        case Op::square_root: count.roots += node.width; break;
        case Op::minimum:
        case Op::maximum:
        case Op::select: count.choices += node.width; break;
        default: count.choices += program::is_condition(node.op) ? node.width : 0;
    }
}

}  // namespace

OperationCount& OperationCount::operator+=(const OperationCount& other) {
    additions += other.additions, multiplications += other.multiplications;
    divisions += other.divisions, roots += other.roots, choices += other.choices;
    return *this;
}

OperationCount operations_of(const program::Graph& graph) {
    OperationCount count;
    for (const program::Node& node : graph.nodes()) {
        if (!node.in_region) count_node(node, count);
    }
    return count;
}

OperationCount operations_of(const program::Graph& graph, program::Block block) {
    OperationCount count;
    for (const program::Node& node : graph.nodes()) {
        if (!node.in_region && node.block == block) count_node(node, count);
    }
    return count;
}

OperationCount operations_of_rhs(const Simulation& simulation) {
    return operations_of(rhs_trace_without_dead_code(simulation.model()).graph);
}

OperationCount operations_of_a_step(const Simulation& simulation) {
    const RhsTrace trace = rhs_trace_without_dead_code(simulation.model());
    OperationCount count = operations_of(trace.graph);
    const MethodCost cost = cost_of(*find_method(simulation.scenario().solver.integrator));
    for (std::int64_t* kind :
         {&count.additions, &count.multiplications, &count.divisions, &count.roots, &count.choices}) {
        *kind *= cost.turns;
    }
    const std::int64_t sums = std::int64_t{cost.products} * simulation.model().vehicle.state_size;
    count.additions += sums + static_cast<std::int64_t>(trace.correction_indices.size());
    count.multiplications += sums;
    if (simulation.model().chart == ChassisChart::quaternion) count.additions += 4, count.multiplications += 9;
    return count;
}

}  // namespace hamilcar
