// One step of the Haar transform of a quad: mean, and half differences.  [Clarberg05 §3; Smal19 §5.3.1.2]

/// `quad`: upper left, upper right, lower left, lower right. The result: scaling coefficient; left - right,
/// upper - lower, and diagonal detail coefficients. Not normalised: a quad is s ± h ± v ± d.
vec4 haar_step(vec4 quad) {
    return 0.25 * vec4(quad.x + quad.y + quad.z + quad.w, quad.x - quad.y + quad.z - quad.w,
                       quad.x + quad.y - quad.z - quad.w, quad.x - quad.y - quad.z + quad.w);
}
