// Java objects as arguments of the shared layer, its results as Java objects, and its exceptions as Java's. set() answers false with a
// Java exception thrown.
#pragma once

#include <jni.h>

#include <cstring>
#include <new>
#include <type_traits>

#include "common/host.h"

namespace dartsweep_java {

// --- arrays of numbers
template <class J>
struct Kind;
#define DSW_KIND(java, Java)                                                                             \
  template <>                                                                                            \
  struct Kind<java> {                                                                                    \
    using Array = java##Array;                                                                           \
    static Array make(JNIEnv *env, jsize count) { return env->New##Java##Array(count); }                 \
    static java *get(JNIEnv *env, Array array) { return env->Get##Java##ArrayElements(array, nullptr); } \
    static void release(JNIEnv *env, Array array, java *data, jint mode) {                               \
      env->Release##Java##ArrayElements(array, data, mode);                                              \
    }                                                                                                    \
    static void set(JNIEnv *env, Array array, jsize count, const java *data) {                           \
      env->Set##Java##ArrayRegion(array, 0, count, data);                                                \
    }                                                                                                    \
    static void read(JNIEnv *env, Array array, jsize count, java *data) {                                \
      env->Get##Java##ArrayRegion(array, 0, count, data);                                                \
    }                                                                                                    \
  };
DSW_KIND(jbyte, Byte)
DSW_KIND(jint, Int)
DSW_KIND(jlong, Long)
DSW_KIND(jdouble, Double)
#undef DSW_KIND

// The elements of a Java array for the time of a call; mode JNI_ABORT where they are only read, 0 where they are written.
template <class J>
class Numbers {
 public:
  using JavaArray = typename Kind<J>::Array;
  Numbers() = default;
  Numbers(const Numbers &) = delete;
  Numbers &operator=(const Numbers &) = delete;
  ~Numbers() {
    if (data_) Kind<J>::release(env_, array_, data_, mode_);
  }

  template <class T>
  T *set(JNIEnv *env, JavaArray array, jint mode) {
    static_assert(sizeof(T) == sizeof(J) && std::is_arithmetic_v<T>, "the same bits");
    if (!array) return nullptr;
    env_ = env, array_ = array, mode_ = mode;
    data_ = Kind<J>::get(env, array);
    if (!data_) throw std::bad_alloc();
    count = static_cast<std::size_t>(env->GetArrayLength(array));
    return reinterpret_cast<T *>(data_);
  }

  std::size_t count = 0;

 private:
  JNIEnv *env_ = nullptr;
  JavaArray array_ = nullptr;
  J *data_ = nullptr;
  jint mode_ = 0;
};

template <class T>
auto to_java(JNIEnv *env, const T *data, std::size_t count) {
  using J =
      std::conditional_t<std::is_floating_point_v<T>, jdouble,
                         std::conditional_t<sizeof(T) == 1, jbyte, std::conditional_t<sizeof(T) == 4, jint, jlong>>>;
  const auto size = static_cast<jsize>(count);
  auto array = Kind<J>::make(env, size);
  if (array) Kind<J>::set(env, array, size, reinterpret_cast<const J *>(data));
  return array;
}

inline void throw_java(JNIEnv *env, const char *type, const char *message) {
  if (!env->ExceptionCheck()) env->ThrowNew(env->FindClass(type), message);
}

inline bool set_doubles(JNIEnv *env, jdoubleArray array, double *out, jsize count) {
  if (array && env->GetArrayLength(array) == count) {
    env->GetDoubleArrayRegion(array, 0, count, out);
    return true;
  }
  throw_java(env, "java/lang/IllegalArgumentException",
             ("an array of " + std::to_string(count) + " numbers is needed").c_str());
  return false;
}

// 2 coordinates in the plane, 3 in space: which of them it has to be, the layer knows.
inline bool set_point(JNIEnv *env, jdoubleArray array, dartsweep::Point &out) {
  const jsize count = array ? env->GetArrayLength(array) : 0;
  if (count == 2 || count == 3) {
    out.size = static_cast<std::uint32_t>(count);
    env->GetDoubleArrayRegion(array, 0, count, out.at);
    return true;
  }
  throw_java(env, "java/lang/IllegalArgumentException", "a point is an array of 3 numbers, or 2 in the plane");
  return false;
}

// Ids are ints in the order of their members; null is the null id.
template <class Id>
void read_id(JNIEnv *env, jintArray numbers, Id *out) {
  *out = {};
  if (numbers) env->GetIntArrayRegion(numbers, 0, sizeof(Id) / 4, reinterpret_cast<jint *>(out));
}

// --- points, as numbers: NativeMemory.of has made a direct buffer of them, or a double[]
class Doubles {
 public:
  explicit Doubles(jint mode = JNI_ABORT) : mode_(mode) {}
  void set(JNIEnv *env, jobject memory, const double *&data, std::size_t &count) {
    double *found = nullptr;
    find(env, memory, found, count);
    data = found;
  }

 protected:
  void find(JNIEnv *env, jobject memory, double *&data, std::size_t &count) {
    if (!memory) return;
    data = static_cast<double *>(env->GetDirectBufferAddress(memory));
    const jlong capacity = env->GetDirectBufferCapacity(memory);
    count = static_cast<std::size_t>(capacity);
    if (capacity >= 0) return;
    data = array_.set<double>(env, static_cast<jdoubleArray>(memory), mode_);
    count = array_.count;
  }

 private:
  Numbers<jdouble> array_;
  jint mode_;
};

class DoublesOut : public Doubles {
 public:
  DoublesOut() : Doubles(0) {}
  void set(JNIEnv *env, jobject memory, double *&data, std::size_t &count) { find(env, memory, data, count); }
};

// --- what outlives a call: a reference to an object, let go on whatever thread
class Reference {
 public:
  Reference(JNIEnv *env, jobject object) : object_(env->NewGlobalRef(object)) { env->GetJavaVM(&machine_); }
  Reference(const Reference &) = delete;
  Reference &operator=(const Reference &) = delete;
  ~Reference() {
    if (JNIEnv *env = environment()) env->DeleteGlobalRef(object_);
  }
  jobject get() const { return object_; }

  // Gives the environment of this thread, which becomes one of Java's threads if it is none. Null only when the machine
  // is going down.
  JNIEnv *environment() const {
    void *env = nullptr;
    if (machine_->GetEnv(&env, JNI_VERSION_1_8) == JNI_OK) return static_cast<JNIEnv *>(env);
    return machine_->AttachCurrentThreadAsDaemon(&env, nullptr) == JNI_OK ? static_cast<JNIEnv *>(env) : nullptr;
  }

 private:
  JavaVM *machine_ = nullptr;
  jobject object_;
};

// A direct buffer stays with the library; an array is copied, since it cannot stay where it is.
inline bool set_lent(JNIEnv *env, jobject memory, dartsweep::Lent &out) {
  if (!memory) {
    throw_java(env, "java/lang/NullPointerException", "positions");
    return false;
  }
  const jlong capacity = env->GetDirectBufferCapacity(memory);
  if (capacity >= 0) {
    out.data = static_cast<double *>(env->GetDirectBufferAddress(memory));
    out.owner = std::make_shared<Reference>(env, memory);
    out.count = static_cast<std::size_t>(capacity);
    return true;
  }
  const auto array = static_cast<jdoubleArray>(memory);
  const jsize count = env->GetArrayLength(array);
  const std::shared_ptr<double[]> copy(new double[static_cast<std::size_t>(count)]);
  env->GetDoubleArrayRegion(array, 0, count, copy.get());
  out.data = copy.get();
  out.owner = copy;
  out.count = static_cast<std::size_t>(count);
  return true;
}

class JavaLog : public dartsweep::LogSink {
 public:
  JavaLog(JNIEnv *env, jobject log) : log_(env, log) {
    jclass type = env->FindClass("dartsweep/NativeMemory");
    write_ = env->GetStaticMethodID(type, "log", "(Ldartsweep/Log;ILjava/lang/String;)V");
    type_ = std::make_unique<Reference>(env, type);
  }
  void write(int level, const char *text) override {
    JNIEnv *env = log_.environment();
    if (!env || env->ExceptionCheck()) return;
    jstring line = env->NewStringUTF(text);
    if (line) env->CallStaticVoidMethod(static_cast<jclass>(type_->get()), write_, log_.get(), jint{level}, line);
    if (env->ExceptionCheck()) env->ExceptionClear();  // a log that throws is not the caller's fault
    if (line) env->DeleteLocalRef(line);
  }

 private:
  Reference log_;
  std::unique_ptr<Reference> type_;
  jmethodID write_ = nullptr;
};

// --- exceptions. To be called in a handler: throws the Java exception that this one stands for.
inline void throw_status(JNIEnv *env, int status, bool closed, const char *message) {
  jclass type = env->FindClass("dartsweep/DartsweepException");
  if (!type) return;
  const jmethodID make = env->GetStaticMethodID(type, "of", "(IZLjava/lang/String;)Ldartsweep/DartsweepException;");
  jstring text = env->NewStringUTF(message);
  jobject made = text ? env->CallStaticObjectMethod(type, make, jint{status}, jboolean{closed}, text) : nullptr;
  if (!env->ExceptionCheck()) env->Throw(static_cast<jthrowable>(made));
}

inline void throw_current(JNIEnv *env) {
  try {
    throw;
  } catch (const dartsweep::Closed &error) {
    throw_status(env, error.status(), true, error.what());
  } catch (const dartsweep::Error &error) {
    throw_status(env, error.status(), false, error.what());
  } catch (const std::out_of_range &error) {
    throw_java(env, "java/lang/IndexOutOfBoundsException", error.what());
  } catch (const std::bad_alloc &) {
    throw_status(env, DSW_STATUS_OUT_OF_MEMORY, false, "out of memory");
  } catch (const std::exception &error) {
    throw_status(env, DSW_STATUS_INTERNAL, false, error.what());
  }
}

}  // namespace dartsweep_java
