//! Numbers without physics: quadrature, distances in ulp, statistics.

pub mod measured;
pub mod quadrature;
pub mod statistics;
pub mod ulp;
