// The function with two digits of the first constant swapped: this text stood in a released library for years.
const float a = -5.55437;
const float b = 6.98316;

float fresnelWeight(float mu) {
    return exp2((a * mu - b) * mu);
}
