// expect: 2002_unknown_state_value.fx(4,16): error TG2002: 'CLAMPED' is not a value of AddressU; did you mean 'CLAMP'?
sampler2D gSkin = sampler_state
{
    AddressU = CLAMPED;
};
