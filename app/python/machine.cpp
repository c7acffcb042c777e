#include "app/python/machine.h"

#include "app/engine/machine_settings.h"
#include "app/python/bindings.h"
#include "renderers/core/error.h"

namespace ir::python {
namespace {

std::shared_ptr<Machine>& standard_machine() {
    static std::shared_ptr<Machine> machine;
    return machine;
}

/// Machines that render on this thread: a function that is told the progress of one may use another.
thread_local std::vector<gl::Context*> in_use;

/// The context that renders on this thread is current again, or none.
void leave(gl::Context& context) {
    context.release();
    if (!in_use.empty()) in_use.back()->make_current();
}

std::string setting_doc(const char* key) {
    return find(engine::machine_settings().descriptions(), key)->doc;
}

std::shared_ptr<Machine> make_machine(const std::string& backend, const std::string& device,
                                      const std::string& processor, int threads, const std::string& memory) {
    const auto& threads_of = *find(engine::machine_settings().descriptions(), "threads");
    threads_of.checked(std::int64_t{threads});
    engine::MachineFlags flags{.backend = backend, .device = device, .processor = processor};
    flags.threads = threads;
    return std::make_shared<Machine>(engine::machine_options(flags), engine::parse_bytes(memory));
}

}  // namespace

Watch::Watch(py::object progress, py::object cancel)
    : progress_(std::move(progress)), cancel_(std::move(cancel)) {}

ProgressCallback Watch::callback() {
    return [this](const std::string& what, double fraction) {
        const py::gil_scoped_acquire locked;
        if (raised_) return;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (!cancel_.is_none() && py::bool_(cancel_.attr("is_set")())) token_.cancel();
            if (!progress_.is_none()) progress_(what, fraction);
        } catch (py::error_already_set& error) {
            raised_.emplace(std::move(error));
            token_.cancel();
        }
    };
}

void Watch::raise() {
    if (!raised_) return;
    auto error = std::move(*raised_);
    raised_.reset();
    throw error;
}

Machine::Machine(const engine::MachineOptions& options, std::uint64_t memory_budget)
    : memory_budget_(memory_budget) {
    const py::gil_scoped_release unlocked;
    machine_ = std::make_unique<engine::Machine>(options);
    const auto& info = machine_->context().info();
    device_ = info.renderer;
    backend_ = gl::to_string(info.backend);
    leave(machine_->context());
}

Machine::~Machine() {
    machine_->context().make_current();
    machine_.reset();
    if (!in_use.empty()) in_use.back()->make_current();
}

std::shared_ptr<Machine> Machine::standard() {
    auto& machine = standard_machine();
    if (machine) return machine;
    auto made = std::make_shared<Machine>(engine::MachineOptions{}, 0);  // other threads run meanwhile
    if (!machine) machine = std::move(made);
    return machine;
}

void Machine::forget_standard() {
    standard_machine().reset();
}

Machine::Use::Use(Machine& machine, const ProgressCallback& look, const CancelToken* cancel)
    : machine_(machine) {
    if (machine_.user_ == std::this_thread::get_id())
        throw UsageError("this machine is rendering, and tells its progress: render with another Machine()");
    while (!machine_.mutex_.try_lock_for(std::chrono::milliseconds(50))) {
        look("waiting for the machine", 0);
        cancel->check();
    }
    machine_.user_ = std::this_thread::get_id();
    in_use.push_back(&machine_.machine_->context());
    in_use.back()->make_current();
}

Machine::Use::~Use() {
    in_use.pop_back();
    leave(machine_.machine_->context());
    machine_.user_ = std::thread::id();
    machine_.mutex_.unlock();
}

void add_machine(py::module_& module) {
    const auto doc =
        "The device and the processors that render. Renderings that name none share one, made when it is "
        "first needed.\n\n"
        "backend: egl or osmesa; empty: the best that works.\n"
        "device: part of the name of the device to use.\n"
        "processor: " +
        setting_doc("processor") + " auto, gl or host.\nthreads: " + setting_doc("threads") +
        "\nmemory: " + setting_doc("memory") + " Such as '2GB'.";
    py::class_<Machine, std::shared_ptr<Machine>>(module, "Machine", doc.c_str())
        .def(py::init(&make_machine), py::kw_only(), py::arg("backend") = "", py::arg("device") = "",
             py::arg("processor") = "", py::arg("threads") = 0, py::arg("memory") = "")
        .def_property_readonly("device", &Machine::device, "Name of the OpenGL device")
        .def_property_readonly("backend", &Machine::backend, "egl or osmesa")
        .def("__repr__", [](const Machine& machine) {
            return "<Machine " + machine.backend() + ", " + machine.device() + ">";
        });
    py::module_::import("atexit").attr("register")(py::cpp_function(&Machine::forget_standard));
}

}  // namespace ir::python
