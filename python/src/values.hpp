// Values of Python as nodes of a document, and back.
#pragma once

#include "hamilcar/io/toml_document.hpp"
#include "python.hpp"

namespace hamilcar::python {

// Numbers, texts, truth values, paths, lists, tuples, arrays, dicts. `place` stands in messages where a file's name would. Throws
// nb::type_error for anything else.
io::Node node_of(nb::handle value, const std::string& place);

nb::object object_of(const io::Node& node);

}  // namespace hamilcar::python
