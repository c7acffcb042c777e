#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>

#include "app/engine/experiment.h"
#include "app/python/machine.h"
#include "app/python/picture.h"
#include "projects/document.h"

namespace ir::python {

/// What is rendered, with a project of its own: what is changed here changes no file and no other one.
class Experiment {
  public:
    Experiment(const std::string& method, const std::string& scene);
    /// Of a project's folder, by its id; its preset is applied.
    Experiment(projects::Project project, const std::string& id, std::filesystem::path folder);

    const projects::Project& project() const { return project_; }
    const projects::Experiment& item() const;
    const std::filesystem::path& folder() const { return folder_; }
    const MethodDescription& method() const;
    std::string scene() const;

    /// Of the method's parameter, or what experiments have besides. Throw UsageError with one line.
    py::object value(const std::string& key) const;
    void set(const std::string& key, const py::object& value);
    void set(const py::dict& changes);

    engine::Experiment resolved() const;
    /// The ground truth that this one is judged by.
    Experiment match(std::uint64_t samples, const std::shared_ptr<Machine>& machine) const;

  private:
    projects::Experiment& item();
    void set_field(const std::string& key, const py::object& value);
    void set_camera(const py::object& camera);
    void set_lights(const py::object* lights, const py::object* environment);

    projects::Project project_;
    std::string id_;
    std::filesystem::path folder_;
    bool is_single_ = false;  ///< made from one scene, without a folder
};

}  // namespace ir::python
