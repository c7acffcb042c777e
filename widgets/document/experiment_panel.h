#pragma once

#include <QSize>
#include <QStringList>
#include <QWidget>
#include <cstdint>
#include <vector>

#include "widgets/parameters/option.h"

class QComboBox;
class QGridLayout;
class QLabel;
class QLineEdit;
class QToolButton;

namespace ir::widgets {

class NumberField;

/// What an experiment is besides its method's parameters.
struct ExperimentFields {
    std::vector<Option> experiments, methods, cameras, lights, presets, scenes;
    QString experiment, method, camera, light, preset, scene;
    QSize size{512, 512};
    std::uint64_t seed = 1;
    int frames = 1;
    double time = 0;
};

/// Chooses the experiment and edits its scene, camera, lights, method, size, seed, frames, time and preset.
class ExperimentPanel : public QWidget {
    Q_OBJECT
  public:
    explicit ExperimentPanel(QWidget* parent = nullptr);
    /// Emits nothing.
    void set_fields(const ExperimentFields& fields);
    void set_read_only(bool read_only, const QString& why);
    /// The menu behind the button beside the experiment's name.
    void set_menu(class QMenu* menu);

  signals:
    void experiment_chosen(const QString& id);
    void method_chosen(const QString& id);
    void camera_chosen(const QString& id);
    void lights_chosen(const QString& id);
    void preset_chosen(const QString& id);
    void scene_chosen(const QString& id);
    void size_chosen(QSize size);
    void seed_chosen(std::uint64_t seed);
    void frames_chosen(int frames);
    void time_chosen(double seconds);

  private:
    using Signal = void (ExperimentPanel::*)(const QString&);
    QComboBox* add_list(const QString& label, const char* name, Signal chosen);
    NumberField* add_number(const char* key);
    void add_row(const QString& label, QWidget* editor, QWidget* button = nullptr);
    void choose_seed();

    QGridLayout* grid_;
    QComboBox *experiment_, *method_, *camera_, *lights_, *preset_, *scene_;
    NumberField *width_, *height_, *frames_, *time_;
    QLineEdit* seed_;
    QToolButton *menu_, *dice_;
    std::vector<QWidget*> editable_;
};

}  // namespace ir::widgets
