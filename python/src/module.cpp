#include "python.hpp"

#include "hamilcar/engine/engines.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/shipped.hpp"

namespace hamilcar::python {

NewNumbers new_numbers(std::vector<double> values, std::vector<std::size_t> shape) {
    auto* held = new std::vector<double>(std::move(values));
    const nb::capsule owner(held, [](void* numbers) noexcept { delete static_cast<std::vector<double>*>(numbers); });
    return NewNumbers(held->data(), shape.size(), shape.data(), owner);
}

// The exceptions are classes of hamilcar._errors, which are told the exit code, the message and the key.
void translate_errors() {
    nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            std::rethrow_exception(thrown);
        } catch (const io::Error& error) {
            const nb::object made = nb::module_::import_("hamilcar._errors")
                                        .attr("error_of")(static_cast<int>(error.code()), error.what(), error.key());
            PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
        }
    });
}

}  // namespace hamilcar::python

NB_MODULE(_core, module) {
    using namespace hamilcar;
    using namespace nanobind::literals;
    module.doc() = "The compiled part of the package hamilcar; use the package.";
    module.attr("version") = HAMILCAR_VERSION;
    python::translate_errors();
    module.def("set_shipped_folder", &io::set_shipped_folder, "folder"_a,
               "Where the files are that come with the package.");
    module.def("find_shipped", &io::find_shipped, "name"_a, "The path of a file that comes with hamilcar, or None.");
    module.def(
        "engine", [] { return std::string(default_engine().name); },
        "Name of the backend that programs are compiled for here: avx512, avx2, sse2 or portable.");
    python::add_documents(module);
    python::add_results(module);
    python::add_simulation(module);
    python::add_batch(module);
    python::add_rollout(module);
    python::add_maneuvers(module);
    python::add_linear(module);
}
