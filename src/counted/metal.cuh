// What naga's Metal text uses, in CUDA: scalars, vectors of two and three floats, and the functions that forms
// call. A form that needs more is not counted on NVIDIA's targets, and the compiler's message says what.
#define constant static constexpr
typedef unsigned int uint;

namespace metal {
using ::uint;

struct float2 {
    float x, y;
    float2() = default;
    constexpr float2(float a) : x(a), y(a) {}
    constexpr float2(float a, float b) : x(a), y(b) {}
    float2 xx() const { return float2(x, x); }
    float2 xy() const { return *this; }
    float2 yx() const { return float2(y, x); }
    float2 yy() const { return float2(y, y); }
    float& operator[](int i) { return (&x)[i]; }
    float operator[](int i) const { return (&x)[i]; }
};

struct float3 {
    float x, y, z;
    float3() = default;
    constexpr float3(float a) : x(a), y(a), z(a) {}
    constexpr float3(float a, float b, float c) : x(a), y(b), z(c) {}
    float3(float2 a, float b) : x(a.x), y(a.y), z(b) {}
    float3(float a, float2 b) : x(a), y(b.x), z(b.y) {}
    float2 xx() const { return float2(x, x); }
    float2 xy() const { return float2(x, y); }
    float2 xz() const { return float2(x, z); }
    float2 yz() const { return float2(y, z); }
    float& operator[](int i) { return (&x)[i]; }
    float operator[](int i) const { return (&x)[i]; }
};

typedef float3 packed_float3;

#define OPERATOR(o) \
    inline float2 operator o(float2 a, float2 b) { return float2(a.x o b.x, a.y o b.y); } \
    inline float3 operator o(float3 a, float3 b) { return float3(a.x o b.x, a.y o b.y, a.z o b.z); } \
    inline float2 operator o(float2 a, float b) { return a o float2(b); } \
    inline float2 operator o(float a, float2 b) { return float2(a) o b; } \
    inline float3 operator o(float3 a, float b) { return a o float3(b); } \
    inline float3 operator o(float a, float3 b) { return float3(a) o b; }
OPERATOR(+) OPERATOR(-) OPERATOR(*) OPERATOR(/)
inline float2 operator-(float2 a) { return float2(-a.x, -a.y); }
inline float3 operator-(float3 a) { return float3(-a.x, -a.y, -a.z); }

#define UNARY(name, value) \
    inline float name(float x) { return value; } \
    inline float2 name(float2 a) { return float2(name(a.x), name(a.y)); } \
    inline float3 name(float3 a) { return float3(name(a.x), name(a.y), name(a.z)); }
UNARY(abs, fabsf(x)) UNARY(floor, floorf(x)) UNARY(ceil, ceilf(x)) UNARY(rint, rintf(x))
UNARY(trunc, truncf(x)) UNARY(fract, x - floorf(x)) UNARY(saturate, __saturatef(x))
UNARY(sign, x > 0.0f ? 1.0f : (x < 0.0f ? -1.0f : 0.0f))
UNARY(sin, sinf(x)) UNARY(cos, cosf(x)) UNARY(atan, atanf(x)) UNARY(tanh, tanhf(x))
UNARY(exp, expf(x)) UNARY(exp2, exp2f(x)) UNARY(log, logf(x)) UNARY(log2, log2f(x))
UNARY(sqrt, sqrtf(x)) UNARY(rsqrt, rsqrtf(x))

#define BINARY(name, value) \
    inline float name(float x, float y) { return value; } \
    inline float2 name(float2 a, float2 b) { return float2(name(a.x, b.x), name(a.y, b.y)); } \
    inline float3 name(float3 a, float3 b) { \
        return float3(name(a.x, b.x), name(a.y, b.y), name(a.z, b.z)); \
    }
BINARY(min, fminf(x, y)) BINARY(max, fmaxf(x, y)) BINARY(pow, powf(x, y))
BINARY(atan2, atan2f(x, y)) BINARY(fmod, fmodf(x, y))

inline int min(int a, int b) { return a < b ? a : b; }
inline int max(int a, int b) { return a > b ? a : b; }
inline int abs(int a) { return a < 0 ? -a : a; }
inline uint min(uint a, uint b) { return a < b ? a : b; }
inline uint max(uint a, uint b) { return a > b ? a : b; }

template <class T> inline T clamp(T x, T low, T high) { return min(max(x, low), high); }
template <class T> inline T select(T a, T b, bool second) { return second ? b : a; }
inline float fma(float a, float b, float c) { return fmaf(a, b, c); }
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline float2 mix(float2 a, float2 b, float2 t) { return a + (b - a) * t; }
inline float3 mix(float3 a, float3 b, float3 t) { return a + (b - a) * t; }
inline float dot(float2 a, float2 b) { return a.x * b.x + a.y * b.y; }
inline float dot(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float length(float2 a) { return sqrtf(dot(a, a)); }
inline float length(float3 a) { return sqrtf(dot(a, a)); }
template <class T> inline T normalize(T a) { return a * rsqrtf(dot(a, a)); }
inline float3 cross(float3 a, float3 b) {
    return float3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
}
