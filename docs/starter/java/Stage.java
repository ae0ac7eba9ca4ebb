// Three stages of the pipeline: reading and writing are done; the calculation is yours.
//
//     java Stage.java view < stage1.txt > stage2.txt
//
// The first word is model, view or project. Try each with
//     pipeline check-stage view -- java Stage.java view
import java.io.*;
import java.util.*;
import java.util.stream.*;

public class Stage {
    static final Set<String> said = new HashSet<>();

    // Says once on stderr what is missing; stdout is for the next stage.
    static void toDo(String text) {
        if (said.add(text)) System.err.println("to do: " + text);
    }

    // Your part. A point is an array of three numbers, a matrix one of four rows.

    // The current matrix after translate X Y Z, scale X Y Z or rotate DEGREES X Y Z.
    static double[][] transformed(double[][] matrix, String command, double[] numbers) {
        toDo("transformed() in Stage.java: multiply the matrix by the command's, which goes on the right");
        return matrix;
    }

    // A vertex of a triangle in world space.
    static double[] toWorld(double[][] matrix, double[] p) {
        toDo("toWorld() in Stage.java: multiply the matrix by the point (x, y, z, 1)");
        return p;
    }

    // A point of world space in view space: the eye at the origin, looking down -z.
    static double[] toView(double[] eye, double[] look, double[] up, double[] p) {
        toDo("toView() in Stage.java: subtract the eye, then turn by the rows r, u and -l");
        return p;
    }

    // A point of view space in normalized device coordinates. The angle is in degrees.
    static double[] toNdc(double fovY, double aspect, double near, double far, double[] p) {
        toDo("toNdc() in Stage.java: multiply by the perspective matrix, then divide by w");
        return p;
    }

    // The rest is done.

    static int count = 0;

    // Writes a vertex, and a blank line after every third.
    static void write(double[] p) {
        System.out.printf(Locale.ROOT, "%.7f %.7f %.7f\n%s", p[0], p[1], p[2], ++count % 3 == 0 ? "\n" : "");
    }

    static double[] numbers(String text) {
        return Arrays.stream(text.split("\\s+")).filter(word -> word.matches("[-+.\\d].*"))
            .mapToDouble(Double::parseDouble).toArray();
    }

    // Reads a scene: four lines of the camera, then commands.
    static void model(Iterator<String> lines) {
        for (String name : new String[] {"eye", "look", "up", "perspective"})
            System.out.print(name + " " + lines.next() + "\n");
        double[][] matrix = new double[4][4];
        for (int i = 0; i < 4; i++) matrix[i][i] = 1;
        Deque<double[][]> saved = new ArrayDeque<>();
        for (String line = lines.next(); !line.equals("end"); line = lines.next()) {
            String command = line.split("\\s+")[0];
            double[] given = numbers(line);  // or none: then they have the next line
            if (command.equals("push")) saved.push(matrix);
            else if (command.equals("pop")) matrix = saved.pop();
            else if (command.equals("triangle"))
                for (int i = 0; i < 3; i++) write(toWorld(matrix, numbers(lines.next())));
            else matrix = transformed(matrix, command, given.length > 0 ? given : numbers(lines.next()));
        }
    }

    // Reads a header of words and numbers, then vertices. View passes the perspective on.
    static void laterStage(boolean isView, Iterator<String> lines) {
        Map<String, double[]> header = new HashMap<>();
        while (lines.hasNext()) {
            String line = lines.next();
            if (Character.isLetter(line.charAt(0))) {
                String word = line.split("\\s+")[0];
                header.put(word, numbers(line.substring(word.length())));
                if (isView && word.equals("perspective")) System.out.print(line + "\n");
                continue;
            }
            double[] p = numbers(line), lens = header.get("perspective");
            write(isView ? toView(header.get("eye"), header.get("look"), header.get("up"), p)
                         : toNdc(lens[0], lens[1], lens[2], lens[3], p));
        }
    }

    public static void main(String[] words) throws IOException {
        BufferedReader in = new BufferedReader(new InputStreamReader(System.in));
        OutputStream out = new FileOutputStream(FileDescriptor.out);
        System.setOut(new PrintStream(new BufferedOutputStream(out), false));
        Iterator<String> lines = in.lines().map(s -> s.split("#", 2)[0].trim()).filter(s -> !s.isEmpty())
            .collect(Collectors.toList()).iterator();
        if (words[0].equals("model")) model(lines);
        else laterStage(words[0].equals("view"), lines);
        System.out.flush();
    }
}
