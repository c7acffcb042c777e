#pragma once

#include <map>
#include <string>

/// OpenGL as the contexts over EGL of this process see it, watched between program and driver. Targets that
/// link `ir_watched_gl` have it; windows of Qt have functions of their own.
namespace ir::test {

/// How many objects of each kind were made and not deleted.
std::map<std::string, int> living_gl_objects();

/// Calls of OpenGL since the newest context was made.
long gl_calls();

/// The `call`-th call from now on, counted from 1, loses its context, as a reset of the device does: from
/// then on calls do nothing, and the context says so, until another one is made. 0: none does. `later`: the
/// same of each context that is made afterwards.
void lose_context_at(long call, long later = 0);
bool was_context_lost();  ///< since the last call of lose_context_at()

/// Buffers and images that got memory.
long gl_storages();

/// The `storage`-th of them from now on, counted from 1, gets none: OpenGL says that it is out of memory. 0:
/// all get it.
void refuse_storage_at(long storage);
bool was_storage_refused();  ///< since the last call of refuse_storage_at()

}  // namespace ir::test
