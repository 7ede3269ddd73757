// What every source of the module needs: nanobind, and how mistakes become exceptions of the package.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

namespace hamilcar::python {

namespace nb = nanobind;
using namespace nb::literals;

using Numbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
// As many dimensions as a shape has; NumPy owns the memory.
using NewNumbers = nb::ndarray<nb::numpy, double>;
NewNumbers new_numbers(std::vector<double> values, std::vector<std::size_t> shape);

// Turns io::Error into hamilcar.Error and its kinds.
void translate_errors();

// One at a time: a simulation that is used from two threads of Python at once is a mistake, not a crash.
class Turn {
public:
    explicit Turn(std::atomic<bool>& busy) : busy_(busy) {
        if (busy_.exchange(true)) throw std::runtime_error("this object is in use by another thread");
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() { busy_ = false; }

private:
    std::atomic<bool>& busy_;
};

// Whether the person pressed Ctrl-C, asked for a few times a second, while the interpreter's lock is released. Python's exception
// is set then: throw nb::python_error with the lock.
class Interruption {
public:
    bool asked() {
        if (interrupted_) return true;
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ < std::chrono::milliseconds(50)) return false;
        last_ = now;
        const nb::gil_scoped_acquire lock;
        return interrupted_ = PyErr_CheckSignals() != 0;
    }
    void raise_if_interrupted() const {
        if (interrupted_) throw nb::python_error();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    bool interrupted_ = false;
};

void add_documents(nb::module_& module);
void add_results(nb::module_& module);
void add_simulation(nb::module_& module);
void add_batch(nb::module_& module);
void add_rollout(nb::module_& module);
void add_maneuvers(nb::module_& module);
void add_linear(nb::module_& module);

}  // namespace hamilcar::python
