// SPDX-License-Identifier: GPL-3.0-or-later
// Table of the words of headers: English, German, French, and Japanese in Latin letters.
#include "header_words.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "header_tokens.hpp"

namespace salebra::detail {
namespace {

using namespace meaning;

struct Entry {
  Meaning meaning;
  std::string_view words;  ///< words with the same meaning, separated by blanks
};

constexpr Entry entries[]{
    {x, "x yoko easting ost"},
    {y, "y tate northing nord"},
    {plane, "xy lateral laterale horizontal horizontale heimen"},
    {z, "z topography topographie topo vertical vertikal verticale suichoku"},
    {height,
     "height heights hoehe hoehen hohe hohen hauteur hauteurs altitude altitudes takasa elevation "
     "hoehenwert hoehenwerte cote"},
    {ordinate,
     "amplitude amplituden profile profil profiles profils profilhoehe depth depths tiefe tiefen "
     "profondeur fukasa relief roughness rauheit rauhigkeit rugosite arasa waviness welligkeit "
     "ondulation ordinate ordonnee purofairu danmen sokuteichi auslenkung deviation abweichung "
     "ecart"},
    {values,
     "value values wert werte messwert messwerte valeur valeurs data daten donnees atai deta "
     "signal"},
    {position,
     "position positions pos distance distances distanz weg messweg tastweg verfahrweg vorschub "
     "vorschubweg strecke taststrecke track trace abscissa abszisse abscisse ort ichi kyori travel "
     "path course parcours laufweg lauf bahn bahnkoordinate deplacement ido chemin s"},
    {width, "width breite largeur haba"},
    {size,
     "size sizes groesse grosse taille extent extents dimension dimensions abmessung abmessungen "
     "etendue ausdehnung okisa field feld champ fov area flaeche messfeld bildfeld shiya"},
    {size | result, "range ranges bereich plage hani messbereich spanne"},
    {length, "length laenge lange longueur nagasa sokuteicho messlaenge messstrecke"},
    {pixel, "pixel pixels px cell cells zelle zellen cellule cellules gaso pikuseru"},
    {pixel | size, "cellsize pixelsize pixelgroesse"},
    {step,
     "spacing pitch step steps schritt schritte schrittweite weite abstand punktabstand "
     "messpunktabstand punkteabstand pas increment inkrement interval intervals intervall "
     "intervalle "
     "kankaku pitchi delta stepsize espacement abtastabstand abtastschritt"},
    {step | x, "dx deltax"},
    {step | y, "dy deltay"},
    {unit, "unit units einheit einheiten masseinheit masseinheiten unite unites tani uom unity"},
    {count, "count counts number num nombre anzahl zahl kosu kazu nb total gesamt qty"},
    {columns,
     "columns column cols col ncols ncolumns spalten spalte spaltenzahl spaltenanzahl "
     "colonnes colonne retsu retsusu nx w"},
    {rows,
     "rows row nrows lines line nlines zeilen zeile zeilenzahl zeilenanzahl lignes ligne "
     "gyo gyou gyosu ny h"},
    {points,
     "points point pts punkte punkt messpunkte messpunkt punktzahl punktanzahl samples "
     "stuetzstellen stuetzpunkte tensu ten npoints npts numpoints datenpunkte echantillons"},
    {factor,
     "factor faktor facteur scale scales scaling skalierung skala massstab echelle multiplier "
     "multiplikator multiplicateur gain verstaerkung sensitivity empfindlichkeit sensibilite "
     "keisu coefficient koeffizient calibration "
     "kalibrierung "
     "kalibrierfaktor etalonnage lsb digit digits exponent skalierungsfaktor "
     "multiply multiplied multipliziert multiplie divide divided geteilt dividiert divise times "
     "mal "
     "fois fach exaggeration exaggerated ueberhoehung ueberhoeht amplified amplification ratio "
     "baika"},
    {factor | conversion, "conversion umrechnung umrechnungsfaktor kansan"},
    {alters,
     "offset offsets versatz decalage ofusetto inverted invert invertiert inversion inverse "
     "mirrored gespiegelt flipped flip rotated gedreht log logarithmic logarithmisch negated "
     "reversed transposed shift corner center centre mitte origin ursprung origine"},
    {alters | x, "xllcorner xllcenter"},
    {alters | y, "yllcorner yllcenter"},
    {missing,
     "nodata missing invalid undefined fehlwert fehlwerte fehlend fehlende ungueltig ungueltige "
     "ungueltiger manquant manquante manquantes manquants invalide invalides masked kesson "
     "kessonchi mukou bad fillvalue fill dummy blank novalue"},
    {mask, "mask maske masque masku valid gueltig valide flag flags status validity"},
    {index,
     "index idx nr no nummer numero bango bangou id pt lfd i n rank rang kennung lfdnr zaehler"},
    {resolution, "resolution aufloesung kaizodo bunkaino res"},
    {result,
     "ra rq rz rt rv rsk rku rsm rmax sa sq sz sp sv ssk sku sdr sdq pa pq pz wa wq wz wt rms "
     "max maximum maximal min minimum minimal mean mittel mittelwert moyenne moyen average "
     "durchschnitt peak peaks valley valleys std sigma saidai saisho heikin pv"},
    {harmless,
     "date datum time zeit uhrzeit messzeit heure jikan jikoku hizuke nichiji timestamp am pm uhr "
     "serial seriennummer seriennr serie serienummer sn seizobango shiriaru operator bediener "
     "pruefer bearbeiter operateur benutzer user utilisateur sagyosha tantosha sample specimen "
     "probe proben muster teil part echantillon piece werkstueck workpiece shiryo shiryou comment "
     "comments kommentar kommentare bemerkung bemerkungen commentaire commentaires remarque remark "
     "remarks note notes notiz biko komento version software firmware program programm programme "
     "logiciel sofuto baajon instrument instrumente geraet messgeraet device appareil model modell "
     "modele machine maschine sochi kishu katashiki type typ magnification magnifications "
     "vergroesserung grossissement zoom bairitsu objective objektiv objectif lens linse lentille "
     "taibutsu renzu voltage spannung messspannung beschleunigungsspannung tension denatsu denryu "
     "current strom courant bias speed geschwindigkeit messgeschwindigkeit vorschubgeschwindigkeit "
     "vitesse velocity sokudo rate scanrate frequency frequenz frequence shuhasu force kraft "
     "messkraft auflagekraft load last charge temperature temperatur ondo humidity feuchte "
     "luftfeuchte feuchtigkeit humidite shitsudo pressure druck luftdruck laser wavelength "
     "wellenlaenge onde hacho led light licht lumiere exposure belichtung belichtungszeit "
     "exposition roshutsu brightness helligkeit contrast kontrast contraste file filename datei "
     "dateiname fichier fairu fairumei name nom namae title titel titre daimei identifier lot los "
     "batch order auftrag auftragsnummer commande project projekt projet customer kunde client "
     "company firma cutoff cut filter filtre grenzwellenlaenge grenzwelle lambda lambdac lambdas "
     "lc "
     "ls tip "
     "tastspitze stylus taster pointe palpeur radius rayon spitzenradius tastspitzenradius needle "
     "nadel cantilever spring feder setpoint sollwert integral proportional copyright author autor "
     "auteur created creation erstellt modified mode modus method methode channel kanal canal "
     "chaneru run essai test session sitzung group gruppe groupe room raum salle site page "
     "seite year month day jahr monat tag jour mois annee hour hours second seconds minute minutes "
     "duration dauer duree "
     "messdauer focal aperture na frame frames averaging averages mittelungen moyennes angle "
     "winkel "
     "kakudo rotation threshold schwelle schwellwert seuil revision release build license din jis "
     "astm norm standard norme certificate report bericht rapport hokokusho licence lizenz licenza "
     "key camera kamera spot working "
     "arbeitsabstand hankei shokushin link http https www ftp website contact kontakt address "
     "adresse phone email mail factory werk usine kojo hall halle department abteilung service "
     "january february march april may june july august "
     "september october november december jan feb mar apr jun jul aug sep sept oct nov dec januar "
     "februar maerz mai juni juli oktober dezember okt dez janvier fevrier mars avril juin juillet "
     "aout septembre octobre novembre decembre monday tuesday wednesday thursday friday saturday "
     "sunday mon tue wed thu fri sat sun montag dienstag mittwoch donnerstag freitag samstag "
     "sonntag "
     "lundi mardi mercredi jeudi vendredi samedi dimanche zygo bruker veeco wyko keyence mitutoyo "
     "taylor hobson talysurf surtronic sensofar alicona dektak olympus leica zeiss mahr hommel "
     "jenoptik nanofocus nanosurf park tencor kla polytec gwyddion mountains mountainsmap digital "
     "surf spip contour newview surftest perthometer marsurf asylum jpk anasys keisokusha kyokusei "
     "auswertelaenge evaluation einzelmessstrecke overlap stitching piezo focus fokus vacuum "
     "vakuum "
     "vide gas power leistung puissance electrode stage tisch table platine coating iso"},
    {harmless | other,
     "intensity intensitaet intensite kido grey gray grau gris red green blue rot gruen blau rouge "
     "vert bleu colour color farbe couleur error fehler erreur gosa phase deflection quality "
     "qualitaet qualite confidence snr noise rauschen bruit reflectivity"},
    {neutral,
     "the of in en de du la le les des der die das den dem d l per pro par and und et for fuer "
     "pour "
     "scan scanned image bild map karte carte measurement measurements measured messung mess "
     "messen mesure mesures measuring sokutei gazo direction richtung axis achse achsen axe axes "
     "jiku jikuhoko hoko coordinate coordinates koordinate koordinaten coordonnee coordonnees "
     "zahyo along entlang actual sampling sensor surface oberflaeche hyomen matrix matrice grid "
     "gitter raster grille array header ascii text texte export exported exportiert from to by on "
     "at with all begin end start ende beginn debut fin list liste content format section "
     "ist each abtast echantillonnage coord coords raw roh brut brute primary filtered unfiltered "
     "corrected levelled leveled relative relativ absolute absolut"},
    {other, "g b"},
    {no, "none off false nein non aus iie keine aucun aucune nashi linear"},
};

const std::unordered_map<std::string_view, Meaning>& table() {
  static const auto words = [] {
    std::unordered_map<std::string_view, Meaning> result;
    for (const auto& [meaning, list] : entries) {
      std::string_view rest = list;
      while (!rest.empty()) {
        const auto end = std::min(rest.find(' '), rest.size());
        if (end > 0) result[rest.substr(0, end)] |= meaning;
        rest.remove_prefix(std::min(end + 1, rest.size()));
      }
    }
    return result;
  }();
  return words;
}

/// The meanings of the parts of a compound word; 0 if the word is not made of known parts. Short
/// words occur in many others by chance, so only axes and the "of" of "NumberOfPoints" may have
/// fewer than three letters. parts: largest number of parts.
Meaning meaning_of_parts(std::string_view word, int parts) {
  if (parts == 0) return 0;
  for (std::size_t size = word.size(); size > 0; --size) {
    const std::string_view head = word.substr(0, size);
    const bool axis = head == "x" || head == "y" || head == "z" || head == "xy";
    if (size < 3 && !axis && head != "of" && !(size == word.size() && head == "nr")) continue;
    const auto found = table().find(head);
    if (found == table().end()) continue;
    std::string_view rest = word.substr(size);
    if (rest.empty()) return found->second;
    for (const std::string_view joint : {"", "s", "n", "en", "es", "e"}) {
      if (!rest.starts_with(joint)) continue;
      if (const Meaning others = meaning_of_parts(rest.substr(joint.size()), parts - 1))
        return found->second | others;
    }
  }
  return 0;
}

}  // namespace

std::string plain_word(std::string_view word) {
  // Lower-case ASCII for the accented letters of Latin-1, from U+00C0 on.
  constexpr std::string_view latin[]{"a",  "a", "a",  "a", "ae", "a", "ae", "c", "e",  "e", "e",
                                     "e",  "i", "i",  "i", "i",  "d", "n",  "o", "o",  "o", "o",
                                     "oe", "*", "oe", "u", "u",  "u", "ue", "y", "th", "ss"};
  std::string result;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const auto byte = static_cast<unsigned char>(word[i]);
    const auto next = i + 1 < word.size() ? static_cast<unsigned char>(word[i + 1]) : 0u;
    if (byte == 0xc3 && (next & 0xc0) == 0x80) {
      result += next == 0x9f ? "ss" : latin[next & 0x1f];
      ++i;
    } else if (byte == 0xc5 && (next == 0x8c || next == 0x8d)) {  // o with a macron
      result += 'o';
      ++i;
    } else if (byte == 0xc5 && (next == 0xaa || next == 0xab)) {  // u with a macron
      result += 'u';
      ++i;
    } else {
      result += static_cast<char>(byte >= 'A' && byte <= 'Z' ? byte - 'A' + 'a' : byte);
    }
  }
  return result;
}

Meaning meaning_of(std::string_view word) {
  constexpr std::size_t longest = 40;
  const std::string plain = plain_word(word);
  if (plain.empty() || plain.size() > longest) return unknown;
  if (const auto found = table().find(plain); found != table().end()) return found->second;
  // Removes a number after a name, which distinguishes columns of one kind: "Z1".
  const auto letters = plain.find_last_not_of("0123456789") + 1;
  if (letters > 0 && letters < plain.size())
    if (const auto found = table().find(std::string_view(plain).substr(0, letters));
        found != table().end())
      return found->second;
  constexpr int most_parts = 4;
  const Meaning parts = meaning_of_parts(plain, most_parts);
  return parts ? parts : unknown;
}

bool is_about_numbers(std::string_view key, std::string_view value) {
  const auto is_joint = [](char symbol) {
    return (symbol >= ' ' && symbol < '0') || symbol == ':' || symbol == '_';
  };
  Meaning all = 0;
  while (!key.empty()) {
    const auto end = std::ranges::find_if(key, is_joint);
    const auto word = std::string_view(key.begin(), end);
    if (!word.empty()) all |= meaning_of(word);
    key = std::string_view(end == key.end() ? end : end + 1, key.end());
  }
  if (all & (harmless | result | index)) return (all & (unit | factor | missing | mask)) != 0;
  if (all & carrying) return true;
  using Kind = HeaderToken::Kind;
  const auto bears = [](const HeaderToken& token) {
    return token.kind == Kind::number || token.kind == Kind::length || token.kind == Kind::other ||
           token.kind == Kind::ratio;
  };
  return (all & unknown) && (is_length_unit(value) || is_other_unit(value) ||
                             std::ranges::any_of(header_tokens(value), bears));
}

}  // namespace salebra::detail
