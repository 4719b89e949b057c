// The function as an engine ships it.
const float a = -5.55473;
const float b = 6.98316;

float fresnelWeight(float mu) {
    return exp2((a * mu - b) * mu);
}
