/* This part of jni.h depends on the machine; it is for Windows on 64 bits: JDKs for other systems do not have it. */
#pragma once

#define JNIEXPORT __declspec(dllexport)
#define JNIIMPORT __declspec(dllimport)
#define JNICALL __stdcall

typedef long jint;
typedef long long jlong;
typedef signed char jbyte;
