#include "hamilcar/engine/casadi_text.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "hamilcar/program/c_text.hpp"
#include "hamilcar/program/derivative.hpp"

namespace hamilcar {

namespace {

// Rows, columns, where each column begins, and the rows of its entries: all of them.
std::string dense_pattern(const std::string& name, int rows, int columns) {
    std::string text = fmt::format("static const casadi_int {}[] = {{{}, {}", name, rows, columns);
    for (int column = 0; column <= columns; ++column) text += fmt::format(", {}", column * rows);
    for (int i = 0; i < rows * columns; ++i) text += fmt::format(", {}", i % rows);
    return text + "};\n";
}

struct Argument {
    std::string name, pattern;
};

// What CasADi asks of a function before it calls it.
std::string description(const std::string& function, const std::vector<Argument>& in, const std::vector<Argument>& out,
                        int work) {
    std::string text =
        fmt::format("casadi_int {0}_n_in(void) {{ return {1}; }}\ncasadi_int {0}_n_out(void) {{ return {2}; }}\n",
                    function, in.size(), out.size());
    for (const auto& [side, all] : {std::pair{"in", &in}, std::pair{"out", &out}}) {
        std::string names, patterns;
        for (std::size_t i = 0; i < all->size(); ++i) {
            names += fmt::format("    if (i == {}) return \"{}\";\n", i, (*all)[i].name);
            patterns += fmt::format("    if (i == {}) return {};\n", i, (*all)[i].pattern);
        }
        text += fmt::format("const char* {}_name_{}(casadi_int i) {{\n{}    return 0;\n}}\n", function, side, names);
        text += fmt::format("const casadi_int* {}_sparsity_{}(casadi_int i) {{\n{}    return 0;\n}}\n", function, side,
                            patterns);
    }
    return text + fmt::format(
                      "int {}_work(casadi_int* arg, casadi_int* res, casadi_int* iw, casadi_int* w) {{\n"
                      "    if (arg) *arg = {};\n    if (res) *res = {};\n    if (iw) *iw = 0;\n    if (w) *w = {};\n"
                      "    return 0;\n}}\n",
                      function, in.size(), out.size(), work);
}

// {0}: numbers of the state, {1}: of the inputs, {2}: of the report.
constexpr const char* functions = R"(
enum {{ states = {0}, inputs = {1}, reports = {2} }};

/* A null pointer means zeros. */
static void copy(const double* from, double* to, int count) {{
    int i;
    for (i = 0; i < count; ++i) to[i] = from ? from[i] : 0;
}}

int car(const double** arg, double** res, casadi_int* iw, double* w, int mem) {{
    double* arrays[5];
    (void)iw;
    (void)mem;
    if (!res[0]) return 0;
    arrays[0] = w;
    arrays[1] = w + states;
    arrays[2] = 0;
    arrays[3] = res[0];
    arrays[4] = w + states + inputs;
    copy(arg[0], arrays[0], states);
    copy(arg[1], arrays[1], inputs);
    car_rates(arrays, 0, 0);
    return 0;
}}

/* Column by column; tangents lie behind the numbers that they belong to. */
int jac_car(const double** arg, double** res, casadi_int* iw, double* w, int mem) {{
    double *arrays[5], *to;
    int column, i;
    (void)iw;
    (void)mem;
    arrays[0] = w;
    arrays[1] = w + 2 * states;
    arrays[2] = 0;
    arrays[3] = arrays[1] + 2 * inputs;
    arrays[4] = arrays[3] + 2 * states;
    copy(arg[0], arrays[0], states);
    copy(arg[1], arrays[1], inputs);
    for (column = 0; column < states + inputs; ++column) {{
        to = column < states ? res[0] : res[1];
        if (!to) continue;
        for (i = 0; i < states; ++i) arrays[0][states + i] = i == column;
        for (i = 0; i < inputs; ++i) arrays[1][inputs + i] = states + i == column;
        car_tangents(arrays, 0, 0);
        copy(arrays[3] + states, to + (column < states ? column : column - states) * states, states);
    }}
    return 0;
}}

)";

}  // namespace

std::string casadi_text(const RhsTrace& trace, int state_size) {
    if (!trace.graph.calls().empty())
        throw std::invalid_argument("an uneven road is no list of operations: expected a plane");
    const int reports = RhsReport::correction + static_cast<int>(trace.correction_indices.size());
    program::DerivativeOptions options;
    options.places[rhs_state] = {rhs_state, state_size};
    options.places[rhs_input] = {rhs_input, RhsInput::size};
    options.places[rhs_rate] = {rhs_rate, state_size};
    options.places[rhs_report] = {rhs_report, reports};
    std::string text = program::c_text(trace.graph, "car_rates") +
                       program::c_text(program::with_tangents(trace.graph, options), "car_tangents");
    text += "\n#define casadi_int long long\n";
    text += fmt::format(functions, state_size, static_cast<int>(RhsInput::size), reports);
    text += dense_pattern("of_state", state_size, 1) + dense_pattern("of_input", RhsInput::size, 1);
    text += dense_pattern("by_state", state_size, state_size) + dense_pattern("by_input", state_size, RhsInput::size);
    text += fmt::format("static const casadi_int nothing[] = {{{}, 1, 0, 0}};\n", state_size);
    const Argument x{"x", "of_state"}, u{"u", "of_input"};
    text += description("car", {x, u}, {{"rate", "of_state"}}, state_size + RhsInput::size + reports);
    text += description("jac_car", {x, u, {"out_rate", "nothing"}},
                        {{"jac_rate_x", "by_state"}, {"jac_rate_u", "by_input"}},
                        2 * (2 * state_size + RhsInput::size + reports));
    return text;
}

}  // namespace hamilcar
