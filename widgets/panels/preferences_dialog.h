#pragma once

#include <QDialog>
#include <map>

#include "widgets/parameters/parameter_panel.h"

class QLabel;

namespace ir::widgets {

/// What a person chooses for all projects. Every choice counts at once: there is nothing to confirm.
class PreferencesDialog : public QDialog {
    Q_OBJECT
  public:
    /// `zeros`: what is said in place of 0, by key.
    explicit PreferencesDialog(const std::vector<ParameterDescription>& preferences,
                               const std::map<std::string, QString>& zeros = {}, QWidget* parent = nullptr);
    /// `given`: options of the command line by the key of what they set, which cannot be chosen then.
    void set_values(const Settings& settings, const std::map<std::string, QString>& given);

  signals:
    void value_chosen(const std::string& key, const ir::Value& value);
    void reset_chosen(const std::string& key);

  private:
    ParameterPanel* panel_;
    QLabel* given_;
};

}  // namespace ir::widgets
