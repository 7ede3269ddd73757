// Values of Python as nodes of a document, and back.
#pragma once

#include "hamilcar/io/toml_document.hpp"
#include "python.hpp"

namespace hamilcar::python {

// One source for all values of a call, as for those of a file; its text is what messages quote, one value after the other.
using Source = std::shared_ptr<io::SourceFile>;
// `place` stands in messages where a file's name would; what is said in a lower generation overrides.
Source typed_in(const std::string& place, int generation);

// Numbers, texts, truth values, paths, lists, tuples, arrays, dicts. Throws nb::type_error for anything else.
io::Node node_of(nb::handle value, const Source& source);

nb::object object_of(const io::Node& node);

}  // namespace hamilcar::python
