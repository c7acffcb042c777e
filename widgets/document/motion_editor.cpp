#include "widgets/document/motion_editor.h"

#include <QGridLayout>
#include <QLabel>
#include <algorithm>

#include "renderers/core/error.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/fields.h"
#include "widgets/document/motion_target.h"
#include "widgets/document/options.h"
#include "widgets/document/ordered_list.h"
#include "widgets/document/short_forms.h"
#include "widgets/style/number_text.h"

namespace ir::widgets {
namespace {

using projects::Motion;

QString text_of(const glm::dvec3& v) {
    return QStringLiteral("%1, %2, %3").arg(number_text(v.x), number_text(v.y), number_text(v.z));
}

QString line_of(const Motion::Key& key, Motion::Kind kind) {
    const auto time = number_text(key.time);
    if (kind == Motion::Kind::camera) return MotionEditor::tr("%1 s: eye %2").arg(time, text_of(key.eye));
    if (kind == Motion::Kind::part)
        return MotionEditor::tr("%1 s: at %2").arg(time, text_of(key.translation));
    const auto strength = MotionEditor::tr("intensity × %1").arg(number_text(key.intensity));
    if (!key.position) return MotionEditor::tr("%1 s: %2").arg(time, strength);
    return MotionEditor::tr("%1 s: at %2, %3").arg(time, text_of(*key.position), strength);
}

}  // namespace

MotionEditor::MotionEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Motion"), this);
    name_ = name_row(grid, ItemKind::motion, tr("What the motion is called"));
    moves_ = new ChoiceField("motion-moves", this);
    row(grid, tr("Moves"), moves_,
        tr("A camera with a pose of its own, a light of a set, or a file of a scene. Another kind of thing "
           "gets one new key"));
    connect(moves_, &ChoiceField::chosen, this, [this](const QString& id) {
        const std::string motion_id = id_;
        emit edit_wanted([motion_id, id](const projects::Project& project) {
            const auto make = field_edit<Motion>(
                motion_id, "what moves", [&](Motion& motion) { set_target(motion, id, project); }, false);
            return make(project);
        });
    });
    loop_ = new ChoiceField("motion-loop", this);
    row(grid, tr("At the end"), loop_, tr("What happens after the last key"));
    connect(loop_, &ChoiceField::chosen, this, [this](const QString& id) {
        emit edit_wanted(field_edit<Motion>(
            id_, "loop", [loops = id == QLatin1String("loop")](Motion& motion) { motion.loop = loops; },
            false));
    });
    smooth_ = new ChoiceField("motion-smooth", this);
    auto* label = row(grid, tr("Between keys"), smooth_, tr("How a camera goes from one key to the next"));
    connect(smooth_, &ChoiceField::chosen, this, [this](const QString& id) {
        emit edit_wanted(field_edit<Motion>(
            id_, "path", [smooth = id == QLatin1String("smooth")](Motion& motion) { motion.smooth = smooth; },
            false));
    });
    rows_.push_back({Motion::Kind::camera, label, smooth_, nullptr});
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
        Key key = motion_.keys.empty() ? rest_ : motion_.keys.back();
        key.extra = projects::Json::object();
        const auto pose = view_pose_ && motion_.kind == Motion::Kind::camera ? view_pose_() : std::nullopt;
        if (pose) key.aim() = *pose;
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
    const auto& camera_fields = projects::key_fields(Motion::Kind::camera);
    const auto& time = projects::field_of(camera_fields, "time").text;
    time_ = make_number(QStringLiteral("key-time"), time, this);
    row(grid, time, time_);
    connect(time_, &NumberField::chosen, this,
            [this](double value) { change_key("time", [value](Key& key) { key.time = value; }); });
    for (const auto kind : {Motion::Kind::camera, Motion::Kind::light, Motion::Kind::part}) {
        if (kind == Motion::Kind::light) make_given_row(grid);
        for (const auto& field : projects::key_fields(kind))
            if (field.text.key != "time") make_field_row(grid, kind, field);
    }
}

void MotionEditor::make_given_row(QGridLayout* grid) {
    given_ = new ChoiceField("key-given", this);
    auto* label =
        row(grid, tr("Keys give"), given_, tr("What of the light changes; all else is as in its set"));
    rows_.push_back({Motion::Kind::light, label, given_, nullptr});
    connect(given_, &ChoiceField::chosen, this, &MotionEditor::choose_given);
}

void MotionEditor::make_field_row(QGridLayout* grid, Motion::Kind kind, const projects::Field<Key>& field) {
    const QString name = QStringLiteral("%1-key-%2").arg(q(to_string(kind)), q(field.text.key));
    const auto change = [this, &field](int index, double value) {
        change_key(q(field.text.label).toLower().toStdString(), [&field, index, value](Key& key) {
            if (!projects::numbers_of(field.slot(key)).empty())
                projects::set_number(field.slot(key), index, value);
        });
    };
    QWidget* control = nullptr;
    if (std::holds_alternative<double Key::*>(field.member)) {
        auto* number = make_number(name, field.text, this);
        connect(number, &NumberField::chosen, this, [change](double value) { change(0, value); });
        control = number;
    } else {
        auto* vector = new VectorField(name, xyz, this);
        vector->set_range(field.text.range);
        connect(vector, &VectorField::chosen, this, change);
        control = vector;
    }
    rows_.push_back({kind, row(grid, field.text, control), control, &field});
}

/// All keys give the same; what is new in them is as where the light stands.
void MotionEditor::choose_given(const QString& given) {
    const auto words = given.split(QLatin1Char('+'));
    const bool position = words.contains(QLatin1String("position")),
               target = words.contains(QLatin1String("target")),
               direction = words.contains(QLatin1String("direction"));
    emit edit_wanted(field_edit<Motion>(
        id_, "what its keys give",
        [=, rest = rest_](Motion& motion) {
            for (auto& key : motion.keys) {
                const auto set = [](auto& member, bool on, const glm::dvec3& first) {
                    if (!on) member.reset();
                    if (on && !member) member = first;
                };
                set(key.position, position, rest.position.value_or(glm::dvec3(0)));
                set(key.look_at, target, rest.look_at.value_or(glm::dvec3(0)));
                set(key.direction, direction, rest.direction.value_or(glm::dvec3(0, -1, 0)));
            }
        },
        false));
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

void MotionEditor::show_rows() {
    Key key = motion_.keys.empty() ? rest_ : motion_.keys.front();
    for (const auto& each : rows_) {
        const bool shown = each.kind == motion_.kind &&
                           (!each.field || !projects::numbers_of(each.field->slot(key)).empty());
        each.label->setVisible(shown);
        each.control->setVisible(shown);
    }
    QStringList given;
    if (key.position) given << QStringLiteral("position");
    if (key.look_at) given << QStringLiteral("target");
    if (key.direction) given << QStringLiteral("direction");
    given_->show_options({{QStringLiteral("position"), tr("Position"), {}},
                          {QStringLiteral("position+target"), tr("Position and what it looks at"), {}},
                          {QStringLiteral("position+direction"), tr("Position and direction"), {}},
                          {QStringLiteral("target"), tr("What it looks at"), {}},
                          {QStringLiteral("direction"), tr("Direction"), {}},
                          {QString(), tr("Intensity alone"), {}}},
                         given.join(QLatin1Char('+')));
}

void MotionEditor::show_key() {
    const bool is_there = chosen_ >= 0 && std::size_t(chosen_) < motion_.keys.size();
    if (!is_there && time_->isEnabled()) {
        const QString why = tr("There is no key yet; add one above.");
        set_usable(time_, why);
        for (const auto& each : rows_) set_usable(each.control, why);
    }
    Key key = is_there ? motion_.keys[std::size_t(chosen_)] : Key();
    time_->show_value(key.time);
    for (const auto& each : rows_) {
        const auto shown = each.field ? projects::numbers_of(each.field->slot(key)) : std::vector<double>();
        if (shown.empty()) continue;
        if (auto* number = qobject_cast<NumberField*>(each.control))
            number->show_value(shown.front());
        else
            static_cast<VectorField*>(each.control)->show_values(shown);
    }
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
    moves_->show_options(motion_targets(shown.project), target_id(motion_));
    loop_->show_options({{QStringLiteral("stay"), tr("It stays there"), {}},
                         {QStringLiteral("loop"), tr("It begins again"), {}}},
                        motion_.loop ? QStringLiteral("loop") : QStringLiteral("stay"));
    smooth_->show_options({{QStringLiteral("straight"), tr("Straight"), tr("With a bend at each key")},
                           {QStringLiteral("smooth"), tr("Smooth"), tr("Along a curve through all keys")}},
                          motion_.smooth ? QStringLiteral("smooth") : QStringLiteral("straight"));
    try {
        rest_ = key_at_rest(motion_, shown.project);
    } catch (const UsageError&) {
        rest_ = {};  // what it moves is gone; the list above says so
    }
    show_rows();
    std::vector<OrderedList::Line> lines;
    for (const auto& key : motion_.keys) {
        const QString text = line_of(key, motion_.kind);
        lines.push_back({text, text});
    }
    chosen_ = std::clamp(chosen_, 0, std::max(0, int(lines.size()) - 1));
    list_->show_lines(lines, chosen_);
    show_key();
}

}  // namespace ir::widgets
