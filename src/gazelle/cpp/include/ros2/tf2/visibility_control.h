#pragma once
#define TF2_PUBLIC __attribute__((visibility("default")))
#define TF2_LOCAL
#define TF2_PUBLIC_TYPE
#define TF2_EXPORT
#define TF2_IMPORT
