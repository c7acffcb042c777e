// Linked into tests of windows when they are built with the thread sanitizer. It does not see that Qt orders
// what one thread hands to the event loop of another, as Qt is not built with it. This tells it so for
// QMetaObject::invokeMethod.
#include <dlfcn.h>
#include <sanitizer/tsan_interface.h>

#include <QMetaObject>

namespace {

/// A call as it waits in an event loop: made by one thread, carried out and destroyed by another.
struct OrderedCall : QtPrivate::QSlotObjectBase {
    explicit OrderedCall(QSlotObjectBase* call) : QSlotObjectBase(&act), call_(call) { __tsan_release(this); }

  private:
    static void act(int operation, QSlotObjectBase* self, QObject* receiver, void** arguments, bool* equal) {
        __tsan_acquire(self);
        auto* ordered = static_cast<OrderedCall*>(self);
        if (operation == Call) ordered->call_->call(receiver, arguments);
        if (operation == Compare) *equal = ordered->call_->compare(arguments);
        __tsan_release(self);  // whoever has the last reference destroys it
        if (operation != Destroy) return;
        ordered->call_->destroyIfLastRef();
        delete ordered;
    }
    QSlotObjectBase* call_;
};

}  // namespace

bool QMetaObject::invokeMethodImpl(QObject* object, QtPrivate::QSlotObjectBase* call, Qt::ConnectionType type,
                                   void* result) {
    static const auto of_qt = reinterpret_cast<decltype(&invokeMethodImpl)>(::dlsym(
        RTLD_NEXT,
        "_ZN11QMetaObject16invokeMethodImplEP7QObjectPN9QtPrivate15QSlotObjectBaseEN2Qt14ConnectionTypeEPv"));
    if (!of_qt) qFatal("Qt has no QMetaObject::invokeMethodImpl of this name");
    return of_qt(object, new OrderedCall(call), type, result);
}
