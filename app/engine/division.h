#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ir::engine {

/// Of what is divided among tasks: "BEGIN-2-of-4".
std::string part_name(const std::string& begin, int index, int count);

/// What is divided among tasks: its parts are files BEGIN-2-of-4.EXTENSION in one folder of a project.
class Division {
  public:
    struct Place {
        std::filesystem::path project, folder;
        std::string begin, extension;
    };

    Division(Place place, int count) : place_(std::move(place)), count_(count) {}
    /// Into how many parts something is divided there: the largest number of which all files are there, else
    /// the largest. 0: there is none.
    static int count_at(const Place& place);

    int count() const { return count_; }
    const std::filesystem::path& project() const { return place_.project; }
    std::filesystem::path file(int index) const;
    /// "part 2 of 4 is not there", …: what `lack` says of a part, unless it is empty.
    std::vector<std::string> missing(const std::function<std::string(int index)>& lack) const;
    /// Removes all parts, and the folder where nothing else is in it.
    void remove() const;

  private:
    Place place_;
    int count_;
};

}  // namespace ir::engine
