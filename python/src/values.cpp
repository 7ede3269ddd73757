#include "values.hpp"

#include <fmt/format.h>

namespace hamilcar::python {

namespace {

constexpr int max_depth = 32;
constexpr std::size_t most_shown = 60;  // of a value in a message

void show(io::Node& node, nb::handle value, const Source& source) {
    const bool is_long =
        nb::isinstance<nb::dict>(value) || (PySequence_Check(value.ptr()) && nb::len(value) > most_shown);
    std::string text = "...";
    if (!is_long) {
        PyObject* shown = PyObject_ASCII(value.ptr());
        if (!shown) throw nb::python_error();  // as of integers with more digits than Python prints
        text = nb::cast<std::string>(nb::steal<nb::str>(shown));
    }
    node.file = source;
    node.key_begin = node.begin = {0, 1 + source->text.size()};  // line 0: in no file
    source->text += text;
    node.end = {0, 1 + source->text.size()};
}

std::string text_of(nb::handle text) {
    Py_ssize_t size = 0;
    const char* bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
    if (!bytes) throw nb::python_error();  // half a character
    return {bytes, static_cast<std::size_t>(size)};
}

io::Node convert(nb::handle value, const Source& source, int depth) {
    if (depth > max_depth) throw nb::value_error("values nested too deep");
    if (nb::hasattr(value, "tolist")) return convert(value.attr("tolist")(), source, depth + 1);  // of NumPy
    io::Node node{.value = io::UnsupportedValue{}};
    show(node, value, source);
    if (nb::isinstance<nb::bool_>(value)) {
        node.value = nb::cast<bool>(value);
    } else if (nb::isinstance<nb::str>(value)) {
        node.value = text_of(value);
    } else if (nb::isinstance<nb::dict>(value)) {
        io::TableValue table;
        for (const auto& [key, entry] : nb::borrow<nb::dict>(value)) {
            if (!nb::isinstance<nb::str>(key)) throw nb::type_error("keys of a table must be texts");
            table.entries.push_back(convert(entry, source, depth + 1));
            table.entries.back().key = text_of(key);
        }
        node.value = std::move(table);
    } else if (nb::isinstance<nb::list>(value) || nb::isinstance<nb::tuple>(value)) {
        io::ListValue list;
        for (const nb::handle item : value) list.items.push_back(convert(item, source, depth + 1));
        node.value = std::move(list);
    } else if (nb::hasattr(value, "__fspath__")) {
        node.value = nb::cast<std::string>(value.attr("__fspath__")());
    } else if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr())) {
        const double number = PyFloat_AsDouble(value.ptr());
        if (number == -1 && PyErr_Occurred()) throw nb::python_error();
        node.value = number;
    } else {
        throw nb::type_error(fmt::format("expected a number, a text, a truth value, a list or a dict; not {}",
                                         nb::cast<std::string>(nb::repr(value.type().attr("__name__"))))
                                 .c_str());
    }
    return node;
}

}  // namespace

io::Node node_of(nb::handle value, const Source& source) {
    return convert(value, source, 0);
}

Source typed_in(const std::string& place, int generation) {
    return std::make_shared<io::SourceFile>(io::SourceFile{place, "", generation});
}

nb::object object_of(const io::Node& node) {
    if (const auto* number = std::get_if<double>(&node.value)) return nb::cast(*number);
    if (const auto* flag = std::get_if<bool>(&node.value)) return nb::cast(*flag);
    if (const auto* text = std::get_if<std::string>(&node.value)) return nb::cast(*text);
    if (const auto* list = std::get_if<io::ListValue>(&node.value)) {
        nb::list out;
        for (const io::Node& item : list->items) out.append(object_of(item));
        return out;
    }
    nb::dict out;
    if (const auto* table = std::get_if<io::TableValue>(&node.value)) {
        for (const io::Node& entry : table->entries) out[entry.key.c_str()] = object_of(entry);
    }
    return out;
}

}  // namespace hamilcar::python
