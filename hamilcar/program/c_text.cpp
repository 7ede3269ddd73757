#include "hamilcar/program/c_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "hamilcar/program/pass.hpp"

namespace hamilcar::program {

namespace {

std::size_t at(Id id) {
    return static_cast<std::size_t>(id);
}

// The text before, between and after the operands.
struct Form {
    std::string_view before, between = "", then = "", after = "";
};

Form form(Op op) {
    switch (op) {
        case Op::add: return {"", " + "};
        case Op::subtract: return {"", " - "};
        case Op::multiply: return {"", " * "};
        case Op::divide: return {"", " / "};
        case Op::less: return {"", " < "};
        case Op::less_equal: return {"", " <= "};
        case Op::equal: return {"", " == "};
        case Op::not_less: return {"!(", " < ", "", ")"};
        case Op::not_less_equal: return {"!(", " <= ", "", ")"};
        case Op::not_equal: return {"!(", " == ", "", ")"};
        case Op::both: return {"", " & "};
        case Op::either: return {"", " | "};
        case Op::opposite: return {"!"};
        case Op::negate: return {"-"};
        case Op::select: return {"", " ? ", " : "};
        default: return {""};
    }
}

class Writer {
public:
    explicit Writer(const Graph& graph)
        : graph_(graph),
          single_(graph.precision() == Precision::single_precision),
          number_(single_ ? "float" : "double") {}

    std::string function(std::string_view name) {
        comment();
        text_ += number_ + (single_ ? " sqrtf(float);\n" : " sqrt(double);\n");
        text_ += number_ + (single_ ? " fabsf(float);\n\n" : " fabs(double);\n\n");
        text_ += "void ";
        text_ += name;
        text_ += "(" + number_ +
                 "* const* arrays,\n    void (*const* functions)(const void* context, int detail, int lanes, ";
        text_ += "const void* arguments, void* results),\n    const void* context) {\n";
        text_ += "    (void)arrays;\n    (void)functions;\n    (void)context;\n";
        auto region = graph_.regions().begin();
        for (Id id = 0; id <= graph_.size(); ++id) {
            while (region != graph_.regions().end() && (in_region_ ? region->last : region->first) == id) {
                in_region_ ? end_region(*region++) : begin_region(*region);
            }
            if (id < graph_.size()) statement(id);
        }
        for (const Output& output : graph_.outputs()) {
            text_ += "    " + element(output.array, output.index) + " = " + name_of(output.node) + ";\n";
        }
        return std::move(text_) + "}\n";
    }

private:
    static std::string element(int array, int index) {
        return "arrays[" + std::to_string(array) + "][" + std::to_string(index) + "]";
    }
    std::string indent() const { return in_region_ ? "        " : "    "; }

    std::string name_of(Id id) const {
        const Node& node = graph_.node(id);
        if (node.op == Op::constant) return constant(graph_.constants(node)[0]);
        if (node.op == Op::truth) return node.a != 0 ? "1" : "0";
        if (node.op == Op::result) return "r" + std::to_string(node.a) + "[" + std::to_string(node.b) + "]";
        return "v" + std::to_string(id);
    }

    // Exact to the last bit, independent of the locale.
    std::string constant(double value) const {
        const std::string suffix = single_ ? "f" : "";
        if (std::isnan(value)) return "(0.0" + suffix + " / 0.0" + suffix + ")";
        if (std::isinf(value)) return std::string(value < 0 ? "(-1.0" : "(1.0") + suffix + " / 0.0" + suffix + ")";
        std::array<char, 64> digits{};
        const auto end = std::to_chars(digits.begin(), digits.end(), std::fabs(value), std::chars_format::hex).ptr;
        const std::string number = "0x" + std::string(digits.begin(), end) + suffix;
        return std::signbit(value) ? "(-" + number + ")" : number;
    }

    void statement(Id id) {
        const Node& node = graph_.node(id);
        switch (node.op) {
            case Op::constant:
            case Op::truth:
            case Op::result:
            case Op::merge: return;
            case Op::call: call(id); return;
            default: break;
        }
        const std::string type = is_condition(node.op) ? "int" : number_;
        text_ += indent() + "const " + type + " " + name_of(id) + " = " + expression(node) + ";\n";
    }

    std::string expression(const Node& node) const {
        if (node.op == Op::input) return element(node.a, node.b);
        const std::string a = name_of(node.a);
        const std::string f = single_ ? "f(" : "(";
        if (node.op == Op::square_root) return "sqrt" + f + a + ")";
        if (node.op == Op::absolute) return "fabs" + f + a + ")";
        if (node.op == Op::minimum) return a + " < " + name_of(node.b) + " ? " + a + " : " + name_of(node.b);
        if (node.op == Op::maximum) return name_of(node.b) + " < " + a + " ? " + a + " : " + name_of(node.b);
        const Form parts = form(node.op);
        const int count = operand_count(node.op);
        std::string text = std::string(parts.before) + a;
        if (count > 1) text += std::string(parts.between) + name_of(node.b);
        if (count > 2) text += std::string(parts.then) + name_of(node.c);
        return text + std::string(parts.after);
    }

    void call(Id id) {
        const Call& call = graph_.calls()[at(graph_.node(id).a)];
        const std::string own = std::to_string(id);
        std::string values;
        for (const Id argument : call.arguments) values += (values.empty() ? "" : ", ") + name_of(argument);
        if (values.empty()) values = "0";  // C has no empty arrays
        text_ += indent() + "const " + number_ + " a" + own + "[] = {" + values + "};\n";
        text_ += indent() + number_ + " r" + own + "[" + std::to_string(std::max(call.result_count, 1)) + "];\n";
        text_ += indent() + "functions[" + std::to_string(call.function) + "](context, " + std::to_string(call.detail) +
                 ", 1, a" + own + ", r" + own + ");\n";
    }

    void begin_region(const Region& region) {
        for (std::size_t i = 0; i < region.defaults.size(); ++i) {
            const Id merge = region.last + static_cast<Id>(i);
            text_ += "    " + number_ + " " + name_of(merge) + " = " + name_of(region.defaults[i]) + ";\n";
        }
        text_ += "    if (" + name_of(region.condition) + ") {\n";
        in_region_ = true;
    }

    void end_region(const Region& region) {
        for (std::size_t i = 0; i < region.results.size(); ++i) {
            const Id merge = region.last + static_cast<Id>(i);
            text_ += "        " + name_of(merge) + " = " + name_of(region.results[i]) + ";\n";
        }
        text_ += "    }\n";
        in_region_ = false;
    }

    void comment() {
        std::array<std::set<int>, max_arrays> read, written;
        for (const Node& node : graph_.nodes()) {
            if (node.op == Op::input) read[at(node.a)].insert(node.b);
        }
        for (const Output& output : graph_.outputs()) written[at(output.array)].insert(output.index);
        text_ += "/* Written by Hamilcar. Compile it with -ffp-contract=off and without -ffast-math.\n\n";
        text_ +=
            "   arrays: arrays of numbers, by number; those that are written must not overlap those that are read.\n";
        for (std::size_t i = 0; i < max_arrays; ++i) {
            if (!read[i].empty()) text_ += "     arrays[" + std::to_string(i) + "]: reads " + list(read[i]) + "\n";
            if (!written[i].empty())
                text_ += "     arrays[" + std::to_string(i) + "]: writes " + list(written[i]) + "\n";
        }
        text_ +=
            "   functions: those that it calls, by number; each is passed `context`, a detail number, 1, arguments "
            "and\n";
        text_ += "     room for results, both of the type of the arrays. May be a null pointer if it calls none.\n";
        for (const Call& call : graph_.calls()) functions_.insert(call.function);
        text_ += functions_.empty() ? "     It calls none. */\n" : "     It calls " + list(functions_) + " */\n";
    }

    // As in "0 to 4, 7, 9".
    static std::string list(const std::set<int>& numbers) {
        std::string text;
        for (auto i = numbers.begin(); i != numbers.end();) {
            const int first = *i;
            int last = first;
            while (++i != numbers.end() && *i == last + 1) ++last;
            text += (text.empty() ? "" : ", ") + std::to_string(first);
            if (last > first) text += " to " + std::to_string(last);
        }
        return text + ".";
    }

    const Graph& graph_;
    bool single_;
    std::string number_;  // the type
    std::string text_;
    std::set<int> functions_;
    bool in_region_ = false;
};

}  // namespace

std::string c_text(const Graph& graph, std::string_view function_name) {
    const Graph single = in_single_numbers(graph);
    return Writer(single).function(function_name);
}

}  // namespace hamilcar::program
