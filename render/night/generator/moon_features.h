// The face of the Moon in words: what is dark, what is bright, where and how large. Places and sizes are
// those of the IAU/USGS Gazetteer of Planetary Nomenclature (planetocentric, east positive); irregular maria
// are given as several ellipses that cover their outline. Albedos are normal albedos: highlands 0.11..0.13,
// maria 0.055..0.075, young craters up to 0.2 (photometric maps after Pohn and Wildey 1970; Aristarchus is
// the brightest large spot).
#pragma once

#include <array>

namespace skyig::render::night {

inline constexpr double kHighlandAlbedo = 0.118;
inline constexpr double kFreshAlbedo = 0.170;

/// An ellipse of even albedo; semi-axes in degrees of the sphere, the first along `bearing_deg` from north
/// through east.
struct MoonPatch {
    const char* name;
    double latitude_deg, longitude_deg, bearing_deg, along_deg, across_deg, albedo;
};

/// A young crater: bright inside, a fading apron, rays of `ray_deg` at most (0: none).
struct MoonCrater {
    const char* name;
    double latitude_deg, longitude_deg, diameter_km, albedo, ray_deg, ray_strength;
};

/// One ray by itself.
struct MoonRay {
    double latitude_deg, longitude_deg, bearing_deg, length_deg, width_deg, strength;
};

inline constexpr std::array kMaria{
    MoonPatch{"Mare Imbrium", 33.5, -16.5, 0, 18.0, 18.5, 0.066},
    MoonPatch{"Sinus Iridum", 44.1, -31.5, 0, 4.2, 4.2, 0.066},
    MoonPatch{"Mare Imbrium, west", 29.0, -36.0, 0, 10.0, 9.0, 0.061},
    MoonPatch{"Mare Serenitatis", 27.5, 18.3, 90, 11.0, 9.8, 0.069},
    MoonPatch{"Mare Tranquillitatis", 9.0, 30.5, 90, 11.5, 9.0, 0.059},
    MoonPatch{"Mare Tranquillitatis, southwest", 4.5, 23.5, 60, 7.0, 5.0, 0.058},
    MoonPatch{"Mare Tranquillitatis, northeast", 13.5, 37.5, 45, 6.5, 5.0, 0.061},
    MoonPatch{"Mare Tranquillitatis, southeast", 2.0, 37.5, 120, 6.0, 4.0, 0.062},
    MoonPatch{"Plinius' strait", 17.5, 24.5, 130, 4.0, 3.2, 0.062},
    MoonPatch{"Sinus Concordiae", 4.5, 43.0, 130, 5.0, 2.2, 0.066},
    MoonPatch{"Sinus Asperitatis", -5.0, 27.0, 10, 4.5, 3.0, 0.075},
    MoonPatch{"Mare Crisium", 17.0, 59.1, 90, 9.2, 7.2, 0.060},
    MoonPatch{"Mare Fecunditatis, north", -2.5, 51.0, 80, 8.5, 6.5, 0.066},
    MoonPatch{"Mare Fecunditatis, south", -11.0, 50.0, 170, 9.0, 5.5, 0.067},
    MoonPatch{"Mare Nectaris", -15.2, 35.0, 0, 5.8, 5.6, 0.068},
    MoonPatch{"Mare Vaporum", 13.3, 3.9, 0, 4.0, 4.2, 0.067},
    MoonPatch{"Palus Putredinis", 29.5, 5.5, 60, 5.5, 2.4, 0.070},
    MoonPatch{"Sinus Medii", 1.6, 1.0, 90, 5.0, 3.2, 0.070},
    MoonPatch{"Sinus Aestuum", 11.5, -8.6, 0, 4.6, 4.6, 0.066},
    MoonPatch{"Mare Frigoris, west", 56.0, -34.0, 75, 9.0, 2.8, 0.080},
    MoonPatch{"Mare Frigoris, middle", 59.5, -12.0, 90, 9.5, 2.8, 0.079},
    MoonPatch{"Mare Frigoris, east", 57.5, 11.0, 105, 9.5, 2.8, 0.080},
    MoonPatch{"Mare Frigoris, end", 54.0, 29.0, 110, 6.5, 2.6, 0.084},
    MoonPatch{"Sinus Roris", 52.0, -53.0, 60, 8.5, 5.5, 0.068},
    MoonPatch{"Oceanus Procellarum, north", 43.0, -58.0, 30, 9.0, 8.0, 0.064},
    MoonPatch{"Oceanus Procellarum, Montes Harbinger", 33.0, -54.0, 0, 11.0, 11.5, 0.061},
    MoonPatch{"Oceanus Procellarum, Marius", 17.0, -55.0, 0, 13.0, 13.0, 0.058},
    MoonPatch{"Oceanus Procellarum, west", 12.0, -64.0, 0, 9.0, 5.0, 0.060},
    MoonPatch{"Oceanus Procellarum, middle", 5.0, -49.0, 0, 12.0, 11.5, 0.059},
    MoonPatch{"Oceanus Procellarum, Flamsteed", -4.5, -47.0, 0, 9.0, 8.5, 0.060},
    MoonPatch{"Oceanus Procellarum, Letronne", -11.0, -43.5, 90, 6.5, 4.5, 0.062},
    MoonPatch{"Oceanus Procellarum, Damoisel", -2.0, -57.0, 20, 7.0, 4.5, 0.062},
    MoonPatch{"Mare Insularum", 6.5, -30.0, 90, 9.0, 7.0, 0.065},
    MoonPatch{"Mare Insularum, east", 3.0, -20.5, 100, 6.5, 4.5, 0.069},
    MoonPatch{"Mare Insularum, Stadius", 9.0, -14.5, 90, 5.0, 3.0, 0.072},
    MoonPatch{"Mare Insularum, Milichius", 12.5, -34.0, 80, 7.0, 4.0, 0.066},
    MoonPatch{"Mare Insularum, Lansberg", -2.0, -26.5, 60, 6.0, 4.0, 0.066},
    MoonPatch{"Mare Cognitum, south", -14.5, -19.0, 130, 5.0, 3.5, 0.069},
    MoonPatch{"Mare Cognitum", -10.5, -23.0, 90, 6.8, 5.4, 0.064},
    MoonPatch{"Mare Cognitum, west", -6.0, -33.0, 110, 7.0, 5.0, 0.065},
    MoonPatch{"Mare Nubium", -20.5, -15.5, 30, 10.5, 8.5, 0.069},
    MoonPatch{"Mare Nubium, south", -27.0, -21.0, 70, 6.0, 4.5, 0.072},
    MoonPatch{"Palus Epidemiarum", -32.0, -28.0, 90, 4.5, 2.4, 0.074},
    MoonPatch{"Mare Humorum", -24.2, -38.8, 0, 6.9, 6.6, 0.061},
    MoonPatch{"Lacus Somniorum", 37.5, 30.5, 110, 6.0, 4.0, 0.083},
    MoonPatch{"Lacus Mortis", 45.1, 27.3, 0, 2.5, 2.5, 0.085},
    MoonPatch{"Mare Humboldtianum", 56.9, 81.5, 120, 4.0, 3.2, 0.074},
    MoonPatch{"Mare Anguis", 22.4, 67.6, 20, 2.4, 1.1, 0.074},
    MoonPatch{"Mare Undarum", 7.0, 68.5, 60, 3.4, 2.0, 0.073},
    MoonPatch{"Mare Spumans", 1.3, 65.3, 30, 2.3, 1.6, 0.074},
    MoonPatch{"Mare Marginis", 13.3, 86.1, 45, 5.5, 3.8, 0.078},
    MoonPatch{"Mare Smythii", -1.7, 87.1, 0, 6.0, 5.5, 0.074},
    MoonPatch{"Mare Australe", -44.0, 90.0, 0, 10.0, 8.0, 0.090},
    MoonPatch{"Mare Orientale", -19.9, -94.7, 0, 4.8, 4.8, 0.075},
    // Floors under lava and dark mantles.
    MoonPatch{"Plato", 51.6, -9.4, 0, 1.65, 1.65, 0.061},
    MoonPatch{"Grimaldi", -5.4, -68.4, 160, 2.9, 2.2, 0.057},
    MoonPatch{"Riccioli", -2.2, -74.0, 20, 1.3, 0.9, 0.068},
    MoonPatch{"Schickard", -43.4, -55.8, 140, 2.0, 1.5, 0.080},
    MoonPatch{"Endymion", 53.9, 57.0, 0, 1.9, 1.9, 0.066},
    MoonPatch{"Archimedes", 29.7, -4.0, 0, 1.3, 1.3, 0.074},
    MoonPatch{"Billy", -13.8, -50.1, 0, 0.8, 0.8, 0.057},
    MoonPatch{"Crueger", -16.7, -66.8, 0, 0.8, 0.8, 0.060},
    MoonPatch{"Julius Caesar", 9.2, 15.2, 0, 1.4, 1.2, 0.070},
    MoonPatch{"Boscovich", 9.8, 11.1, 0, 0.8, 0.7, 0.064},
    MoonPatch{"Firmicus", 7.3, 63.4, 0, 0.95, 0.95, 0.070},
    MoonPatch{"Rima Bode", 9.5, -4.0, 60, 2.2, 1.1, 0.056},
    MoonPatch{"Taurus-Littrow", 19.5, 28.5, 120, 2.0, 1.0, 0.054},
    MoonPatch{"Sulpicius Gallus", 20.0, 10.0, 50, 1.8, 0.8, 0.055},
    MoonPatch{"Le Monnier", 26.6, 30.6, 0, 1.0, 1.0, 0.066},
};

/// Land that stands in the maria or bounds them.
inline constexpr std::array kLands{
    MoonPatch{"Montes Apenninus", 20.3, -2.8, 48, 10.5, 1.9, 0.130},
    MoonPatch{"Montes Caucasus", 38.0, 9.6, 160, 4.8, 1.9, 0.122},
    MoonPatch{"Montes Alpes", 47.3, -0.6, 125, 6.0, 1.7, 0.122},
    MoonPatch{"Between Imbrium and Frigoris", 53.3, -20.0, 88, 10.5, 1.6, 0.110},
    MoonPatch{"Montes Jura", 48.2, -35.5, 62, 5.0, 1.3, 0.116},
    MoonPatch{"Montes Carpatus", 14.8, -25.0, 92, 5.0, 0.9, 0.096},
    MoonPatch{"Montes Archimedes", 26.0, -5.0, 90, 2.4, 1.4, 0.088},
    MoonPatch{"Aristarchus plateau", 26.2, -51.0, 45, 2.8, 2.0, 0.083},
    MoonPatch{"Fra Mauro", -5.5, -17.5, 10, 3.4, 2.4, 0.094},
    MoonPatch{"Montes Riphaeus", -7.7, -27.9, 15, 2.8, 0.5, 0.104},
    MoonPatch{"Palus Somni", 14.1, 45.0, 30, 3.2, 2.6, 0.108},
    MoonPatch{"Gassendi", -17.6, -40.1, 0, 1.8, 1.8, 0.098},
    MoonPatch{"Between Nubium and Humorum", -24.0, -29.5, 10, 5.5, 1.6, 0.104},
    MoonPatch{"Descartes", -11.0, 16.0, 0, 0.9, 0.9, 0.150},
    MoonPatch{"Reiner Gamma", 7.5, -59.0, 60, 1.3, 0.6, 0.112},
    MoonPatch{"Montes Spitzbergen", 34.5, -5.2, 0, 0.7, 0.4, 0.100},
    MoonPatch{"Mons Pico", 45.7, -8.9, 0, 0.4, 0.4, 0.110},
};

inline constexpr std::array kCraters{
    MoonCrater{"Tycho", -43.3, -11.4, 85, 0.150, 26, 0.40},
    MoonCrater{"Copernicus", 9.6, -20.1, 96, 0.125, 18, 0.52},
    MoonCrater{"Kepler", 8.1, -38.0, 30, 0.145, 12, 0.55},
    MoonCrater{"Aristarchus", 23.7, -47.4, 40, 0.200, 9, 0.50},
    MoonCrater{"Proclus", 16.1, 46.8, 27, 0.185, 10, 0.42},
    MoonCrater{"Langrenus", -8.9, 61.1, 132, 0.138, 10, 0.25},
    MoonCrater{"Stevinus A", -31.9, 51.6, 14, 0.180, 14, 0.42},
    MoonCrater{"Furnerius A", -33.5, 59.0, 14, 0.175, 12, 0.38},
    MoonCrater{"Byrgius A", -24.6, -63.8, 19, 0.180, 11, 0.42},
    MoonCrater{"Anaxagoras", 73.5, -10.2, 51, 0.155, 16, 0.38},
    MoonCrater{"Thales", 61.8, 50.3, 32, 0.160, 11, 0.36},
    MoonCrater{"Glushko", 8.1, -77.7, 40, 0.165, 13, 0.40},
    MoonCrater{"Zucchius", -61.4, -50.3, 64, 0.135, 9, 0.25},
    MoonCrater{"Petavius B", -19.9, 57.1, 33, 0.150, 9, 0.32},
    MoonCrater{"Menelaus", 16.3, 16.0, 27, 0.150, 5, 0.25},
    MoonCrater{"Manilius", 14.5, 9.1, 38, 0.140, 4, 0.20},
    MoonCrater{"Dionysius", 2.8, 17.3, 18, 0.165, 3, 0.25},
    MoonCrater{"Censorinus", -0.4, 32.7, 8, 0.200, 2, 0.40},
    MoonCrater{"Timocharis", 26.7, -13.1, 34, 0.105, 4, 0.25},
    MoonCrater{"Pytheas", 20.6, -20.6, 20, 0.120, 2, 0.20},
    MoonCrater{"Euler", 23.3, -29.2, 28, 0.105, 3, 0.25},
    MoonCrater{"Lambert", 25.8, -21.0, 30, 0.090, 0, 0.00},
    MoonCrater{"Eratosthenes", 14.5, -11.3, 58, 0.098, 0, 0.00},
    MoonCrater{"Aristillus", 33.9, 1.2, 55, 0.108, 4, 0.25},
    MoonCrater{"Autolycus", 30.7, 1.5, 39, 0.108, 3, 0.25},
    MoonCrater{"Lalande", -4.5, -8.6, 24, 0.145, 5, 0.28},
    MoonCrater{"Moesting A", -3.2, -5.2, 13, 0.155, 3, 0.20},
    MoonCrater{"Godin", 1.8, 10.2, 34, 0.140, 4, 0.20},
    MoonCrater{"Hipparchus C", -7.3, 8.2, 17, 0.155, 2, 0.20},
    MoonCrater{"Theophilus", -11.4, 26.4, 100, 0.128, 5, 0.15},
    MoonCrater{"Maedler", -11.0, 29.8, 28, 0.125, 2, 0.15},
    MoonCrater{"Taruntius", 5.6, 46.5, 56, 0.098, 4, 0.20},
    MoonCrater{"Messier", -1.9, 47.6, 11, 0.110, 0, 0.00},
    MoonCrater{"Bessel", 21.7, 17.9, 16, 0.100, 0, 0.00},
    MoonCrater{"Plinius", 15.4, 23.7, 43, 0.095, 0, 0.00},
    MoonCrater{"Posidonius", 31.8, 29.9, 95, 0.098, 0, 0.00},
    MoonCrater{"Eudoxus", 44.3, 16.3, 67, 0.126, 3, 0.15},
    MoonCrater{"Aristoteles", 50.2, 17.4, 87, 0.112, 3, 0.15},
    MoonCrater{"Cassini", 40.2, 4.6, 57, 0.098, 0, 0.00},
    MoonCrater{"Reinhold", 3.3, -22.8, 42, 0.092, 0, 0.00},
    MoonCrater{"Lansberg", -0.3, -26.6, 38, 0.092, 0, 0.00},
    MoonCrater{"Bullialdus", -20.7, -22.2, 61, 0.104, 2, 0.10},
    MoonCrater{"Euclides", -7.4, -29.5, 11, 0.150, 1, 0.30},
    MoonCrater{"Wichmann", -7.5, -38.1, 10, 0.120, 1, 0.20},
    MoonCrater{"Mersenius C", -19.8, -45.9, 14, 0.155, 2, 0.25},
    MoonCrater{"Olbers A", 8.1, -77.6, 43, 0.150, 6, 0.20},
    MoonCrater{"Hayn", 64.7, 85.2, 87, 0.140, 8, 0.25},
    MoonCrater{"Kant C", -11.0, 22.1, 20, 0.150, 2, 0.20},
};

inline constexpr std::array kLongRays{
    // Of Tycho: over Clavius and the pole, to Mare Nectaris, past Stevinus, over Mare Nubium (two), to Mare
    // Humorum.
    MoonRay{-43.3, -11.4, 20, 74, 0.9, 0.30},
    MoonRay{-43.3, -11.4, 62, 48, 1.1, 0.42},
    MoonRay{-43.3, -11.4, 96, 42, 1.0, 0.34},
    MoonRay{-43.3, -11.4, 128, 30, 1.0, 0.32},
    MoonRay{-43.3, -11.4, 165, 26, 0.9, 0.32},
    MoonRay{-43.3, -11.4, 196, 28, 0.9, 0.34},
    MoonRay{-43.3, -11.4, 238, 30, 1.0, 0.32},
    MoonRay{-43.3, -11.4, 275, 34, 0.9, 0.30},
    MoonRay{-43.3, -11.4, 322, 40, 0.8, 0.42},
    MoonRay{-43.3, -11.4, 328, 40, 0.8, 0.42},
    // Of Messier A over Mare Fecunditatis, and across Mare Serenitatis through Bessel.
    MoonRay{-2.0, 47.0, 272, 5, 0.35, 0.35},
    MoonRay{-2.2, 47.0, 265, 5, 0.35, 0.35},
    MoonRay{17.0, 16.5, 15, 20, 0.5, 0.28},
};

}  // namespace skyig::render::night
