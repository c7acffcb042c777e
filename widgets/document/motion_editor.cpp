#include "widgets/document/motion_editor.h"

#include <QGridLayout>
#include <QLabel>
#include <algorithm>

#include "renderers/core/error.h"
#include "widgets/document/field_edit.h"
#include "widgets/document/fields.h"
#include "widgets/document/options.h"
#include "widgets/document/ordered_list.h"
#include "widgets/parameters/row_state.h"

namespace ir::widgets {
namespace {

using projects::Motion;

const QStringList xyz{QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("z")};

std::vector<double> numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

MotionEditor::MotionEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Motion"), this);
    name_ = name_row(grid, ItemKind::motion, tr("What the motion is called"));
    camera_ = new ChoiceField("motion-camera", this);
    row(grid, tr("Camera"), camera_, tr("The camera that moves; it needs a pose of its own"));
    connect(camera_, &ChoiceField::chosen, this, [this](const QString& id) {
        emit edit_wanted(field_edit<Motion>(
            id_, "camera", [id = id.toStdString()](Motion& motion) { motion.camera = id; }, false));
    });
    make_keys(make_form_section(tr("Keys"), this));
}

void MotionEditor::make_keys(QGridLayout* grid) {
    list_ = new OrderedList("keys", tr("key"), 0, this);
    list_->set_movable(false);  // they stand in the order of their times
    add_wide(grid, list_);
    connect(list_, &OrderedList::current_changed, this, [this](int index) {
        chosen_ = index;
        show_key();
    });
    connect(list_, &OrderedList::add_wanted, this, [this] {
        Key key = motion_.keys.empty() ? Key() : motion_.keys.back();
        key.extra = projects::Json::object();
        if (const auto pose = view_pose_ ? view_pose_() : std::nullopt) {
            key.eye = pose->eye;
            key.target = pose->target;
            key.up = pose->up;
        }
        add_key(key, motion_.keys.empty() ? 0 : motion_.keys.back().time + 1);
    });
    connect(list_, &OrderedList::duplicate_wanted, this, [this](int index) {
        const Key key = motion_.keys[std::size_t(index)];
        const bool is_last = std::size_t(index) + 1 == motion_.keys.size();
        const double next = is_last ? key.time + 2 : motion_.keys[std::size_t(index) + 1].time;
        add_key(key, (key.time + next) / 2);
    });
    connect(list_, &OrderedList::remove_wanted, this, [this](int index) {
        emit edit_wanted(field_edit<Motion>(
            id_, "keys",
            [index](Motion& motion) {
                if (std::size_t(index) < motion.keys.size()) motion.keys.erase(motion.keys.begin() + index);
            },
            false));
    });
    time_ = make_number("key-time", -1e6, 1e6, QStringLiteral("s"), this);
    row(grid, tr("Time"), time_, tr("Seconds; between two keys the pose is interpolated linearly"));
    connect(time_, &NumberField::chosen, this,
            [this](double value) { change_key("time", [value](Key& key) { key.time = value; }); });
    eye_ =
        vector_row(grid, "key-eye", tr("Eye"), tr("Where the camera is then: x, y, z in metres"), &Key::eye);
    target_ = vector_row(grid, "key-target", tr("Target"), tr("What it looks at then: x, y, z in metres"),
                         &Key::target);
    up_ = vector_row(grid, "key-up", tr("Up"), tr("Direction that is up in the picture then"), &Key::up);
}

VectorField* MotionEditor::vector_row(QGridLayout* grid, const char* name, const QString& label,
                                      const QString& tip, glm::dvec3 Key::*member) {
    auto* field = new VectorField(name, xyz, this);
    row(grid, label, field, tip);
    connect(field, &VectorField::chosen, this, [this, label, member](int index, double value) {
        change_key(label.toLower().toStdString(), [=](Key& key) { (key.*member)[index] = value; });
    });
    return field;
}

void MotionEditor::change_key(const std::string& field, const std::function<void(Key&)>& change) {
    const int index = chosen_;
    emit edit_wanted(field_edit<Motion>(id_, "key " + std::to_string(index + 1) + " " + field,
                                        [index, change](Motion& motion) {
                                            if (index < 0 || std::size_t(index) >= motion.keys.size())
                                                throw UsageError("there is no such key any more");
                                            change(motion.keys[std::size_t(index)]);
                                        }));
}

void MotionEditor::add_key(const Key& key, double time) {
    Key added = key;
    added.time = time;
    const auto later = [&](const Key& other) { return other.time > time; };
    chosen_ = int(std::find_if(motion_.keys.begin(), motion_.keys.end(), later) - motion_.keys.begin());
    emit edit_wanted(field_edit<Motion>(
        id_, "keys",
        [added, index = chosen_](Motion& motion) {
            const auto place = std::min(std::size_t(index), motion.keys.size());
            motion.keys.insert(motion.keys.begin() + std::ptrdiff_t(place), added);
        },
        false));
}

void MotionEditor::show_key() {
    const bool is_there = chosen_ >= 0 && std::size_t(chosen_) < motion_.keys.size();
    if (!is_there && time_->isEnabled())
        for (QWidget* control : std::initializer_list<QWidget*>{time_, eye_, target_, up_})
            set_usable(control, tr("There is no key yet; add one above."));
    const Key key = is_there ? motion_.keys[std::size_t(chosen_)] : Key();
    time_->show_value(key.time);
    eye_->show_values(numbers(key.eye));
    target_->show_values(numbers(key.target));
    up_->show_values(numbers(key.up));
}

void MotionEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    if (item != shown_item_) chosen_ = 0;
    shown_item_ = item;
    id_ = item.id.toStdString();
    motion_ = *projects::find_item(shown.project.motion, id_);
    const QString why_not = shown.read_only ? shown.why_read_only : QString();
    set_controls_usable(why_not);
    list_->set_usable(why_not);
    name_->show_text(QString::fromStdString(motion_.name));
    camera_->show_options(named_options(shown.project.cameras), QString::fromStdString(motion_.camera));
    std::vector<OrderedList::Line> lines;
    for (const auto& key : motion_.keys) {
        const QString text = tr("%1 s: eye %2, %3, %4")
                                 .arg(number_text(key.time), number_text(key.eye.x), number_text(key.eye.y),
                                      number_text(key.eye.z));
        lines.push_back({text, text});
    }
    chosen_ = std::clamp(chosen_, 0, std::max(0, int(lines.size()) - 1));
    list_->show_lines(lines, chosen_);
    show_key();
}

}  // namespace ir::widgets
